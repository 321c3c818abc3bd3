// SPDX-License-Identifier: Apache-2.0
#include "Field.h"

#include <algorithm>
#include <cmath>

namespace qplc::messages {

namespace {

constexpr int hexDigits = 16;

bool isHexDigit(QChar character)
{
    return (character >= QLatin1Char('0') && character <= QLatin1Char('9'))
        || (character >= QLatin1Char('a') && character <= QLatin1Char('f'));
}

}  // namespace

bool Wire<QString>::fromJson(const QJsonValue &json, QString *value)
{
    if (json.isString())
        *value = json.toString();
    return json.isString();
}

bool Wire<bool>::fromJson(const QJsonValue &json, bool *value)
{
    if (json.isBool())
        *value = json.toBool();
    return json.isBool();
}

bool Wire<double>::fromJson(const QJsonValue &json, double *value)
{
    if (json.isDouble())
        *value = json.toDouble();
    return json.isDouble();
}

QJsonValue Wire<Hex64>::toJson(Hex64 value)
{
    return QStringLiteral("%1").arg(value.number, hexDigits, 16, QLatin1Char('0'));
}

bool Wire<Hex64>::fromJson(const QJsonValue &json, Hex64 *value)
{
    const QString digits = json.toString();
    // toULongLong() alone would also read "0x1", "+1" and " 1".
    if (digits.size() != hexDigits || !std::all_of(digits.cbegin(), digits.cend(), isHexDigit))
        return false;
    *value = digits.toULongLong(nullptr, 16);
    return true;
}

QJsonValue Wire<QByteArray>::toJson(const QByteArray &value)
{
    return QString::fromLatin1(value.toBase64());
}

bool Wire<QByteArray>::fromJson(const QJsonValue &json, QByteArray *value)
{
    const QByteArray base64 = json.toString().toLatin1();
    const auto result = QByteArray::fromBase64Encoding(base64, QByteArray::AbortOnBase64DecodingErrors);
    if (!json.isString() || !result || base64.size() % 4 != 0)
        return false;
    *value = result.decoded;
    return true;
}

std::optional<double> wholeNumber(const QJsonValue &json, double minimum, double maximum)
{
    const double number = json.toDouble(std::numeric_limits<double>::quiet_NaN());
    if (!(number >= minimum && number <= maximum) || std::trunc(number) != number)
        return std::nullopt;
    return number;
}

QString outOfRangeText(const char *name, double number, Range range)
{
    constexpr int digits = 16;
    return QStringLiteral("field '%1' is %2; it has to be %3 ... %4")
        .arg(QLatin1String(name))
        .arg(number, 0, 'g', digits)
        .arg(range.minimum, 0, 'g', digits)
        .arg(range.maximum, 0, 'g', digits);
}

QString unusableText(const char *name, const char *type)
{
    return QStringLiteral("field '%1' is missing or not of type %2").arg(QLatin1String(name), QLatin1String(type));
}

}  // namespace qplc::messages

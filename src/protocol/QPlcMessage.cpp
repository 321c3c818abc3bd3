// SPDX-License-Identifier: Apache-2.0
#include "QPlcMessage.h"

#include <QtCore/QMetaEnum>

#include <algorithm>

namespace {

constexpr int HexDigits = 16;

bool isHexDigit(QChar character)
{
    return (character >= QLatin1Char('0') && character <= QLatin1Char('9'))
        || (character >= QLatin1Char('a') && character <= QLatin1Char('f'));
}

}  // namespace

QString QPlcMessage::kindName() const
{
    return kindName(m_kind);
}

QString QPlcMessage::kindName(Kind kind)
{
    const char *name = QMetaEnum::fromType<Kind>().valueToKey(kind);
    return name != nullptr ? QString::fromLatin1(name) : QStringLiteral("unknown kind %1").arg(int(kind));
}

quint64 QPlcMessage::hex64(const QString &field) const
{
    const QString digits = text(field);
    // toULongLong() alone would also read "0x1", "+1" and " 1".
    if (digits.size() != HexDigits || !std::all_of(digits.cbegin(), digits.cend(), isHexDigit))
        return 0;
    return digits.toULongLong(nullptr, 16);
}

QString QPlcMessage::fromHex64(quint64 number)
{
    return QStringLiteral("%1").arg(number, HexDigits, 16, QLatin1Char('0'));
}

QByteArray QPlcMessage::bytes(const QString &field) const
{
    const QByteArray base64 = text(field).toLatin1();
    const auto result = QByteArray::fromBase64Encoding(base64, QByteArray::AbortOnBase64DecodingErrors);
    return result && base64.size() % 4 == 0 ? result.decoded : QByteArray();
}

QString QPlcMessage::fromBytes(const QByteArray &bytes)
{
    return QString::fromLatin1(bytes.toBase64());
}

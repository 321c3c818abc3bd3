// SPDX-License-Identifier: Apache-2.0
#include "ValueText.h"

#include <QtCore/QByteArray>
#include <QtCore/QDate>
#include <QtCore/QLocale>

#include <cmath>
#include <limits>

namespace qplc {

namespace {

constexpr qint64 nanosecondsPerSecond = 1000000000;
constexpr qint64 secondsPerDay = 86400;
constexpr qint64 julianDayOf1970 = 2440588;
constexpr int fractionDigits = 9;

bool isDigit(QChar character)
{
    return character >= QLatin1Char('0') && character <= QLatin1Char('9');
}

// Position behind the digits that begin at `position`.
int skipDigits(const QString &text, int position)
{
    while (position < text.size() && isDigit(text.at(position)))
        ++position;
    return position;
}

int skipSign(const QString &text, int position)
{
    const bool hasSign
        = position < text.size() && (text.at(position) == QLatin1Char('+') || text.at(position) == QLatin1Char('-'));
    return hasSign ? position + 1 : position;
}

// [sign] digits [. digits] [e [sign] digits], with at least one digit before the exponent
bool isDecimalText(const QString &text)
{
    const int begin = skipSign(text, 0);
    int position = skipDigits(text, begin);
    int digits = position - begin;
    if (position < text.size() && text.at(position) == QLatin1Char('.')) {
        const int fraction = position + 1;
        position = skipDigits(text, fraction);
        digits += position - fraction;
    }
    if (digits == 0)
        return false;
    if (position < text.size() && text.at(position).toLower() == QLatin1Char('e')) {
        const int exponent = skipSign(text, position + 1);
        position = skipDigits(text, exponent);
        return position > exponent && position == text.size();
    }
    return position == text.size();
}

// Texts of zeros, infinities and NaN; empty for other numbers.
QString specialText(double value)
{
    if (std::isnan(value))
        return QStringLiteral("nan");
    if (std::isinf(value))
        return value > 0 ? QStringLiteral("inf") : QStringLiteral("-inf");
    if (std::fpclassify(value) == FP_ZERO)
        return std::signbit(value) ? QStringLiteral("-0") : QStringLiteral("0");
    return QString();
}

// Whether `text` looks like `pattern`, in which every 0 stands for a digit.
bool matches(const QString &text, const char *pattern)
{
    for (int i = 0; pattern[i] != '\0'; ++i) {
        const QChar expected = QLatin1Char(pattern[i]);
        if (expected == QLatin1Char('0') ? !isDigit(text.at(i)) : text.at(i) != expected)
            return false;
    }
    return true;
}

// seconds * 1e9 + fraction, where 0 <= fraction < 1e9. False when it does not fit.
bool join(qint64 seconds, qint64 fraction, qint64 *time)
{
    using Limits = std::numeric_limits<qint64>;
    if (seconds < 0) {  // towards zero, so that the product fits where the sum does
        ++seconds;
        fraction -= nanosecondsPerSecond;
    }
    if (qAbs(seconds) > Limits::max() / nanosecondsPerSecond)
        return false;
    const qint64 whole = seconds * nanosecondsPerSecond;
    if (fraction < 0 ? whole < Limits::min() - fraction : whole > Limits::max() - fraction)
        return false;
    *time = whole + fraction;
    return true;
}

}  // namespace

QString realText(double value)
{
    const QString special = specialText(value);
    return special.isEmpty() ? QString::number(value, 'g', QLocale::FloatingPointShortest) : special;
}

QString realText(float value)
{
    constexpr int mostDigits = 9;  // always suffice
    const double exact = double(value);
    const int sureDigits = std::abs(value) < std::numeric_limits<float>::min() ? 1 : 6;  // always survive
    QString text = specialText(exact);
    for (int digits = sureDigits; text.isEmpty(); ++digits) {
        const QString candidate = QString::number(exact, 'g', digits);
        const double read = candidate.toDouble();
        if (digits == mostDigits || !(float(read) < value || float(read) > value))
            text = candidate;
    }
    return text;
}

bool realFromText(const QString &text, double *value, bool *tooLarge)
{
    *tooLarge = false;
    const QString word = text.toLower();
    if (word == QLatin1String("nan")) {
        *value = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    if (word == QLatin1String("inf") || word == QLatin1String("+inf") || word == QLatin1String("-inf")) {
        const double infinity = std::numeric_limits<double>::infinity();
        *value = word.startsWith(QLatin1Char('-')) ? -infinity : infinity;
        return true;
    }
    if (!isDecimalText(text))
        return false;
    *value = text.toDouble();
    *tooLarge = std::isinf(*value);
    return true;
}

bool isIntegerText(const QString &text)
{
    const int begin = skipSign(text, 0);
    return begin < text.size() && skipDigits(text, begin) == text.size();
}

QString timeText(qint64 time)
{
    qint64 seconds = time / nanosecondsPerSecond;
    qint64 fraction = time % nanosecondsPerSecond;
    if (fraction < 0) {
        fraction += nanosecondsPerSecond;
        --seconds;
    }
    qint64 day = seconds / secondsPerDay;
    qint64 second = seconds % secondsPerDay;
    if (second < 0) {
        second += secondsPerDay;
        --day;
    }
    const QDate date = QDate::fromJulianDay(julianDayOf1970 + day);
    QString text = QString::asprintf("%04d-%02d-%02dT%02d:%02d:%02d", date.year(), date.month(), date.day(),
                                     int(second / 3600), int(second / 60 % 60), int(second % 60));
    if (fraction != 0) {
        QString digits = QString::asprintf(".%09d", int(fraction));
        while (digits.endsWith(QLatin1Char('0')))
            digits.chop(1);
        text += digits;
    }
    return text + QLatin1Char('Z');
}

bool timeFromText(const QString &text, qint64 *time)
{
    constexpr int secondsEnd = 19;  // "0000-00-00T00:00:00"
    if (text.size() <= secondsEnd || !matches(text, "0000-00-00T00:00:00") || !text.endsWith(QLatin1Char('Z')))
        return false;
    QString digits = text.mid(secondsEnd, text.size() - secondsEnd - 1);
    if (!digits.isEmpty()) {
        const bool isFraction = digits.at(0) == QLatin1Char('.') && digits.size() > 1
            && digits.size() <= fractionDigits + 1 && skipDigits(digits, 1) == digits.size();
        if (!isFraction)
            return false;
        digits.remove(0, 1);
    }
    const QDate date(text.mid(0, 4).toInt(), text.mid(5, 2).toInt(), text.mid(8, 2).toInt());
    const int hour = text.mid(11, 2).toInt();
    const int minute = text.mid(14, 2).toInt();
    const int second = text.mid(17, 2).toInt();
    if (!date.isValid() || hour > 23 || minute > 59 || second > 59)
        return false;
    const qint64 seconds = (date.toJulianDay() - julianDayOf1970) * secondsPerDay + hour * 3600 + minute * 60 + second;
    return join(seconds, digits.leftJustified(fractionDigits, QLatin1Char('0')).toLongLong(), time);
}

}  // namespace qplc

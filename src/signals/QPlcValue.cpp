// SPDX-License-Identifier: Apache-2.0
#include "QPlcValue.h"

#include "MessageText.h"
#include "QSplitPrimitive.h"
#include "Utf8.h"
#include "ValueText.h"

#include <QtCore/QStringList>

#include <cmath>
#include <cstring>
#include <limits>

using qplc::quoted;

namespace {

constexpr qint64 nanosecondsPerMillisecond = 1000000;
constexpr int textHeader = 2;  // [byte] in front of a text: its length

// Calls `function` with a zero of the type that holds one element.
template<typename Function>
auto withElement(QPlcSignalType::Scalar scalar, Function function)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        return function(qint8());
    case QPlcSignalType::Int16:
        return function(qint16());
    case QPlcSignalType::Int32:
        return function(qint32());
    case QPlcSignalType::UInt8:
        return function(quint8());
    case QPlcSignalType::UInt16:
        return function(quint16());
    case QPlcSignalType::UInt32:
        return function(quint32());
    case QPlcSignalType::UInt64:
        return function(quint64());
    case QPlcSignalType::Real32:
        return function(float());
    case QPlcSignalType::Real64:
        return function(double());
    default:
        return function(qint64());
    }
}

template<typename T>
T elementAt(const char *bytes, int element)
{
    return QSplitPrimitive<T>::fromBytes(bytes + std::size_t(element) * sizeof(T));
}

template<typename T>
void setElementAt(char *bytes, int element, T value)
{
    QSplitPrimitive<T>(value).toBytes(bytes + std::size_t(element) * sizeof(T));
}

bool isFloat(double value)
{
    constexpr double roundsToInfinity = 0x1.ffffffp127;  // halfway between the largest float and 2^128
    return !std::isfinite(value) || std::abs(value) < roundsToInfinity;
}

// Whether the integer type To has the number `value`, which is an integer itself.
template<typename To, typename From>
bool isInRange(From value)
{
    using Limits = std::numeric_limits<To>;
    if constexpr (std::is_floating_point_v<From>)
        return value >= From(Limits::min()) && value < std::ldexp(From(1), Limits::digits);
    else if constexpr (std::is_signed_v<From> == std::is_signed_v<To>)
        return value >= Limits::min() && value <= Limits::max();
    else if constexpr (std::is_signed_v<From>)
        return value >= 0 && std::make_unsigned_t<From>(value) <= Limits::max();
    else
        return value <= std::make_unsigned_t<To>(Limits::max());
}

// The number `value` as another type. False when it is not there: NaN or out of range.
template<typename To, typename From>
bool convertNumber(From value, To *result)
{
    if constexpr (std::is_floating_point_v<To>) {
        if (std::is_same_v<To, float> && !isFloat(double(value)))
            return false;
        *result = To(value);
    } else {
        if constexpr (std::is_floating_point_v<From>)
            value = std::round(value);
        if (!isInRange<To>(value))
            return false;
        *result = To(value);
    }
    return true;
}

template<typename To, typename From>
To saturated(From value, bool *ok)
{
    *ok = !std::isnan(double(value));
    To result = To(0);
    if (*ok && !convertNumber(value, &result))
        result = value < From(0) ? std::numeric_limits<To>::min() : std::numeric_limits<To>::max();
    return result;
}

template<typename To>
To elementAs(const QPlcValue &value, const char *bytes, int element, bool *ok)
{
    bool isThere = value.isValid() && !value.type().isString() && element >= 0 && element < value.type().count();
    To result = To(0);
    if (isThere) {
        result = withElement(value.type().scalar(), [&](auto zero) {
            return saturated<To>(elementAt<decltype(zero)>(bytes, element), &isThere);
        });
    }
    if (ok)
        *ok = isThere;
    return result;
}

// ---- text of one element ----

template<typename T>
QString rangeText()
{
    return QStringLiteral("%1 ... %2").arg(std::numeric_limits<T>::min()).arg(std::numeric_limits<T>::max());
}

template<typename T>
QString readReal(const QString &text, QPlcSignalType type, T *result)
{
    double value = 0.0;
    bool tooLarge = false;
    if (!qplc::realFromText(text, &value, &tooLarge))
        return QStringLiteral("%1 is not a number; write one like -1.5, 2e-3, nan or inf").arg(quoted(text));
    if (tooLarge || (std::is_same_v<T, float> && !isFloat(value)))
        return QStringLiteral("%1 is too large for %2; write a number of at most %3")
            .arg(quoted(text), type.name(), qplc::realText(std::numeric_limits<T>::max()));
    *result = T(value);
    return QString();
}

template<typename T>
QString readInteger(const QString &text, QPlcSignalType type, T *result)
{
    if (std::is_same_v<T, qint8> && (text == QLatin1String("true") || text == QLatin1String("false"))) {
        *result = text == QLatin1String("true") ? T(1) : T(0);
        return QString();
    }
    if (!qplc::isIntegerText(text))
        return QStringLiteral("%1 is not an integer; write a whole number in %2").arg(quoted(text), rangeText<T>());
    bool ok = false;
    if constexpr (std::is_signed_v<T>) {
        const qint64 value = text.toLongLong(&ok);
        ok = ok && convertNumber(value, result);
    } else {
        const bool isNegative = text.startsWith(QLatin1Char('-'));
        const quint64 magnitude = (isNegative ? text.mid(1) : text).toULongLong(&ok);
        ok = ok && (!isNegative || magnitude == 0) && convertNumber(magnitude, result);
    }
    if (ok)
        return QString();
    return QStringLiteral("%1 is out of range for %2; write a number in %3")
        .arg(quoted(text), type.name(), rangeText<T>());
}

// The reason why `text` is no element of `type`; empty: it is one, and `bytes` has it.
QString readElement(const QString &text, QPlcSignalType type, char *bytes, int element)
{
    if (type.isDateTime()) {
        qint64 time = 0;
        if (!qplc::timeFromText(text, &time))
            return QStringLiteral("%1 is not a time; write UTC between 1677-09-21 and 2262-04-11 as in "
                                  "2026-01-31T12:00:00.123456789Z")
                .arg(quoted(text));
        setElementAt(bytes, element, time);
        return QString();
    }
    return withElement(type.scalar(), [&](auto value) {
        QString reason;
        if constexpr (std::is_floating_point_v<decltype(value)>)
            reason = readReal(text, type, &value);
        else
            reason = readInteger(text, type, &value);
        if (reason.isEmpty())
            setElementAt(bytes, element, value);
        return reason;
    });
}

QString elementText(QPlcSignalType type, const char *bytes, int element)
{
    if (type.isDateTime())
        return qplc::timeText(elementAt<qint64>(bytes, element));
    return withElement(type.scalar(), [&](auto zero) {
        const auto value = elementAt<decltype(zero)>(bytes, element);
        if constexpr (std::is_floating_point_v<decltype(zero)>)
            return qplc::realText(value);
        else
            return QString::number(value);
    });
}

QString wrongCount(QPlcSignalType type, const QString &text, int given)
{
    if (type.count() == 1)
        return QStringLiteral("%1 holds %2 values, %3 needs one; the decimal point is '.'")
            .arg(quoted(text))
            .arg(given)
            .arg(type.name());
    return QStringLiteral("%1 holds %2 values, %3 needs %4; write them separated by commas, or one for all")
        .arg(quoted(text))
        .arg(given)
        .arg(type.name())
        .arg(type.count());
}

}  // namespace

// ---- making ----

QPlcValue::QPlcValue(QPlcSignalType type)
    : m_type(type)
{
    if (type.size() > InlineSize)
        m_heap = QByteArray(type.size(), '\0');
}

QPlcValue::QPlcValue(QPlcSignalType::Scalar scalar, const void *elements, int count)
    : QPlcValue(QPlcSignalType(scalar, count))
{
    char *const bytes = data();
    withElement(scalar, [&](auto value) {
        for (int i = 0; i < m_type.count(); ++i) {
            std::memcpy(&value, static_cast<const char *>(elements) + std::size_t(i) * sizeof value, sizeof value);
            setElementAt(bytes, i, value);
        }
    });
}

QPlcValue::QPlcValue(const QString &text)
{
    if (text.isValidUtf16())
        assignText(text.toUtf8());
}

QPlcValue::QPlcValue(const char *text)
{
    const QByteArray utf8(text);
    if (qplc::firstInvalidUtf8(utf8.constData(), utf8.size()) < 0)
        assignText(utf8);
}

QPlcValue::QPlcValue(const QDateTime &time)
{
    const qint64 milliseconds = time.toMSecsSinceEpoch();
    if (time.isValid() && qAbs(milliseconds) <= std::numeric_limits<qint64>::max() / nanosecondsPerMillisecond) {
        *this = QPlcValue(QPlcSignalType(QPlcSignalType::DateTime));
        setElementAt(data(), 0, milliseconds * nanosecondsPerMillisecond);
    }
}

void QPlcValue::assignText(const QByteArray &utf8)
{
    const QPlcSignalType type(QPlcSignalType::String, qMax(utf8.size(), QPlcSignalType::DefaultStringCapacity));
    *this = QPlcValue(type);
    if (!isValid())
        return;
    setElementAt(data(), 0, quint16(utf8.size()));
    std::memcpy(data() + textHeader, utf8.constData(), std::size_t(utf8.size()));
}

char *QPlcValue::data()
{
    return m_type.size() > InlineSize ? m_heap.data() : m_inline.data();
}

const char *QPlcValue::data() const
{
    return m_type.size() > InlineSize ? m_heap.constData() : m_inline.data();
}

// ---- bytes ----

QPlcValue QPlcValue::fromBytes(QPlcSignalType type, const void *bytes)
{
    const char *const source = static_cast<const char *>(bytes);
    QPlcValue result(type);
    int used = type.size();
    if (type.isString()) {
        const int length = elementAt<quint16>(source, 0);
        if (length > type.capacity() || qplc::firstInvalidUtf8(source + textHeader, length) >= 0)
            return QPlcValue();
        used = textHeader + length;  // the rest stays zero
    }
    std::memcpy(result.data(), source, std::size_t(used));
    return result;
}

QPlcValue QPlcValue::fromBytes(QPlcSignalType type, const QByteArray &bytes)
{
    return bytes.size() == type.size() ? fromBytes(type, static_cast<const void *>(bytes.constData())) : QPlcValue();
}

QByteArray QPlcValue::toBytes() const
{
    return QByteArray(data(), m_type.size());
}

void QPlcValue::toBytes(void *bytes) const
{
    std::memcpy(bytes, data(), std::size_t(m_type.size()));
}

// ---- text ----

QPlcValue QPlcValue::fromString(QPlcSignalType type, const QString &text, QString *error)
{
    QString reason;
    QPlcValue result(type);
    if (!type.isValid()) {
        reason = QStringLiteral("the type is not valid; take one of QPlcSignalType::fromName()");
    } else if (type.isString()) {
        result = QPlcValue(text).convertedTo(type);
        if (!result.isValid())
            reason = QStringLiteral("%1 has %2 bytes of UTF-8, %3 holds %4; shorten it or enlarge the type")
                         .arg(quoted(text))
                         .arg(text.toUtf8().size())
                         .arg(type.name())
                         .arg(type.capacity());
    } else {
        const QStringList parts = text.split(QLatin1Char(','));
        if (parts.size() != 1 && parts.size() != type.count())
            reason = wrongCount(type, text, parts.size());
        for (int i = 0; i < type.count() && reason.isEmpty(); ++i)
            reason = readElement(parts.at(parts.size() == 1 ? 0 : i).trimmed(), type, result.data(), i);
    }
    if (error)
        *error = reason;
    return reason.isEmpty() ? result : QPlcValue();
}

QString QPlcValue::toString() const
{
    if (m_type.isString())
        return QString::fromUtf8(data() + textHeader, elementAt<quint16>(data(), 0));
    QStringList parts;
    for (int i = 0; i < m_type.count(); ++i)
        parts.append(elementText(m_type, data(), i));
    return parts.join(QStringLiteral(", "));
}

// ---- numbers ----

double QPlcValue::toReal(int element, bool *ok) const
{
    const bool isThere = isValid() && !m_type.isString() && element >= 0 && element < m_type.count();
    if (ok)
        *ok = isThere;
    if (!isThere)
        return 0.0;
    return withElement(m_type.scalar(), [&](auto zero) { return double(elementAt<decltype(zero)>(data(), element)); });
}

qint64 QPlcValue::toInt64(int element, bool *ok) const
{
    return elementAs<qint64>(*this, data(), element, ok);
}

quint64 QPlcValue::toUInt64(int element, bool *ok) const
{
    return elementAs<quint64>(*this, data(), element, ok);
}

int QPlcValue::toInt(int element, bool *ok) const
{
    return elementAs<int>(*this, data(), element, ok);
}

uint QPlcValue::toUInt(int element, bool *ok) const
{
    return elementAs<uint>(*this, data(), element, ok);
}

QDateTime QPlcValue::toDateTime() const
{
    if (!m_type.isDateTime())
        return QDateTime();
    const qint64 time = toInt64();
    const qint64 milliseconds = time / nanosecondsPerMillisecond - (time % nanosecondsPerMillisecond < 0 ? 1 : 0);
    return QDateTime::fromMSecsSinceEpoch(milliseconds, Qt::UTC);
}

bool QPlcValue::isFinite() const
{
    for (int i = 0; m_type.isReal() && i < m_type.count(); ++i) {
        if (!std::isfinite(toReal(i)))
            return false;
    }
    return true;
}

// ---- conversion ----

QPlcValue QPlcValue::convertedTo(QPlcSignalType type) const
{
    if (type == m_type)
        return *this;
    QPlcValue result(type);
    if (m_type.isString() && type.isString()) {
        const int length = elementAt<quint16>(data(), 0);
        if (length > type.capacity())
            return QPlcValue();
        std::memcpy(result.data(), data(), std::size_t(textHeader + length));
        return result;
    }
    if (!m_type.isNumeric() || !type.isNumeric() || (m_type.count() != 1 && m_type.count() != type.count()))
        return QPlcValue();
    char *const bytes = result.data();
    const bool isComplete = withElement(m_type.scalar(), [&](auto from) {
        return withElement(type.scalar(), [&](auto to) {
            for (int i = 0; i < type.count(); ++i) {
                from = elementAt<decltype(from)>(data(), m_type.count() == 1 ? 0 : i);
                if (!convertNumber(from, &to))
                    return false;
                setElementAt(bytes, i, to);
            }
            return true;
        });
    });
    return isComplete ? result : QPlcValue();
}

QVariant QPlcValue::toVariant() const
{
    const auto elementVariant = [this](int element) {
        switch (m_type.scalar()) {
        case QPlcSignalType::Real32:
            return QVariant(toReal32(element));
        case QPlcSignalType::Real64:
            return QVariant(toReal(element));
        case QPlcSignalType::Int64:
            return QVariant(toInt64(element));
        case QPlcSignalType::UInt64:
            return QVariant(toUInt64(element));
        case QPlcSignalType::UInt8:
        case QPlcSignalType::UInt16:
        case QPlcSignalType::UInt32:
            return QVariant(toUInt(element));
        case QPlcSignalType::DateTime:
            return QVariant(toDateTime());
        case QPlcSignalType::String:
            return QVariant(toString());
        case QPlcSignalType::Invalid:
            return QVariant();
        default:
            return QVariant(toInt(element));
        }
    };
    if (!m_type.isArray())
        return elementVariant(0);
    QVariantList list;
    for (int i = 0; i < m_type.count(); ++i)
        list.append(elementVariant(i));
    return list;
}

bool operator==(const QPlcValue &a, const QPlcValue &b)
{
    return a.m_type == b.m_type && std::memcmp(a.data(), b.data(), std::size_t(a.m_type.size())) == 0;
}

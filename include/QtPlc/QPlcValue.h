// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalType.h"

#include <QtCore/QByteArray>
#include <QtCore/QDateTime>
#include <QtCore/QVariant>

#include <array>
#include <cstddef>
#include <type_traits>

/// A value of any plc signal type: the convenient face of the bytes in the process image.
///
/// Values of up to 24 bytes (all scalars, triples) are kept inside the object and cost no allocation; larger arrays
/// and texts use the heap. Inside QtPLC values travel as bytes, never as QPlcValue.
///
/// A value type; different objects may be used from different threads.
class QTPLC_EXPORT QPlcValue
{
public:
    QPlcValue() = default;                   ///< invalid
    QPlcValue(const QPlcValue &) = default;  // and so a move is a copy, which is as cheap
    QPlcValue &operator=(const QPlcValue &) = default;
    explicit QPlcValue(QPlcSignalType type);  ///< zero of that type
    /// A number or a truth value (Int8, 0 or 1). A template, so that no pointer or enumeration becomes a truth value.
    template<typename T, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, long double>, int> = 0>
    QPlcValue(T value)
        : QPlcValue(scalarOf<T>(), &value, 1)
    {
    }
    template<typename T, std::size_t N, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, char>, int> = 0>
    QPlcValue(const T (&values)[N])
        : QPlcValue(scalarOf<T>(), values, int(N))
    {
        static_assert(N * sizeof(T) <= QPlcSignalType::MaximumSize,
                      "a signal has at most QPlcSignalType::MaximumSize bytes");
    }
    template<typename T, std::size_t N>
    QPlcValue(const std::array<T, N> &values)
        : QPlcValue(scalarOf<T>(), values.data(), int(N))
    {
        static_assert(N > 0 && N * sizeof(T) <= QPlcSignalType::MaximumSize,
                      "a signal has 1 to QPlcSignalType::MaximumSize bytes");
    }
    /// String with the capacity that the text needs, at least the default; invalid when the text has more than 1438 bytes of UTF-8
    /// or half a surrogate pair.
    QPlcValue(const QString &text);
    QPlcValue(const char *text);       ///< As above, from UTF-8; invalid when it is malformed
    QPlcValue(const QDateTime &time);  ///< DateTime, ns since 1970-01-01 UTC; invalid outside 1677 ... 2262

    /// The value whose packed little-endian bytes begin at \a bytes; type.size() of them are read. Invalid for a text whose
    /// length is beyond the capacity or that is not UTF-8.
    static QPlcValue fromBytes(QPlcSignalType type, const void *bytes);
    /// As above; invalid when \a bytes has another size than the type.
    static QPlcValue fromBytes(QPlcSignalType type, const QByteArray &bytes);
    /// Reads what a person types: "1.5", "1, 2, 3", "true", "2026-01-31T12:00:00Z". One number stands for all elements of an array.
    /// \return an invalid value when \a text is no value of \a type (garbage behind a number, out of range, text too long); \a error says why, and is empty otherwise
    static QPlcValue fromString(QPlcSignalType type, const QString &text, QString *error = nullptr);

    bool isValid() const { return m_type.isValid(); }
    QPlcSignalType type() const { return m_type; }

    /// type().size() packed little-endian bytes.
    QByteArray toBytes() const;
    /// Writes type().size() bytes to \a bytes.
    void toBytes(void *bytes) const;

    // One element as a number: 0 when there is none (\a ok false). Times are nanoseconds. Real to integer rounds to nearest and saturates; NaN gives 0 with ok false.
    double toReal(int element = 0, bool *ok = nullptr) const;
    double toReal64(int element = 0, bool *ok = nullptr) const { return toReal(element, ok); }
    float toReal32(int element = 0, bool *ok = nullptr) const { return float(toReal(element, ok)); }
    qint64 toInt64(int element = 0, bool *ok = nullptr) const;
    quint64 toUInt64(int element = 0, bool *ok = nullptr) const;
    int toInt(int element = 0, bool *ok = nullptr) const;
    uint toUInt(int element = 0, bool *ok = nullptr) const;
    bool toBool(int element = 0) const { return toReal(element) != 0.0; }
    /// Elements 0 ... 2 of a triple.
    std::array<double, 3> toRealTriple() const { return {toReal(0), toReal(1), toReal(2)}; }
    /// In UTC, rounded down to the millisecond that QDateTime knows; invalid when this is no time.
    QDateTime toDateTime() const;
    /// What fromString() reads back: shortest text that gives the same bits, elements separated by ", ".
    QString toString() const;

    /// Whether every element of a real value is finite; true for other types.
    bool isFinite() const;
    /// The same quantity as another type: numbers to numbers element by element (one number to all elements of an
    /// array), texts to texts that are long enough, times to times. Invalid when it cannot be done without losing more than precision
    /// (other number of elements, integer out of range, text too long).
    QPlcValue convertedTo(QPlcSignalType type) const;
    QVariant toVariant() const;
    operator QVariant() const { return toVariant(); }

    /// Same type and same bytes (so NaN equals NaN, and -0.0 differs from 0.0).
    friend QTPLC_EXPORT bool operator==(const QPlcValue &a, const QPlcValue &b);
    friend bool operator!=(const QPlcValue &a, const QPlcValue &b) { return !(a == b); }

private:
    template<typename T>
    static constexpr QPlcSignalType::Scalar scalarOf()
    {
        static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, long double>, "no signal type has such elements");
        if constexpr (std::is_same_v<T, bool>)
            return QPlcSignalType::Int8;
        else if constexpr (std::is_same_v<T, float>)
            return QPlcSignalType::Real32;
        else if constexpr (std::is_floating_point_v<T>)
            return QPlcSignalType::Real64;
        else if constexpr (std::is_signed_v<T>)
            return sizeof(T) == 1 ? QPlcSignalType::Int8
                : sizeof(T) == 2  ? QPlcSignalType::Int16
                : sizeof(T) == 4  ? QPlcSignalType::Int32
                                  : QPlcSignalType::Int64;
        else
            return sizeof(T) == 1 ? QPlcSignalType::UInt8
                : sizeof(T) == 2  ? QPlcSignalType::UInt16
                : sizeof(T) == 4  ? QPlcSignalType::UInt32
                                  : QPlcSignalType::UInt64;
    }
    QPlcValue(QPlcSignalType::Scalar scalar, const void *elements, int count);
    void assignText(const QByteArray &utf8);
    char *data();
    const char *data() const;

    static constexpr int InlineSize = 24;
    QPlcSignalType m_type;
    std::array<char, InlineSize> m_inline{};
    QByteArray m_heap;
};

Q_DECLARE_METATYPE(QPlcValue)

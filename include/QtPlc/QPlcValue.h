// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalType.h"

#include <QtCore/QByteArray>
#include <QtCore/QDateTime>
#include <QtCore/QVariant>

#include <array>
#include <cstddef>
#include <type_traits>

/// A value of any signal type, for code that does not know the type when it is compiled.
///
/// \code
/// QPlcValue value = QPlcValue::fromString(QPlcSignalType::fromName("Real32[3]"), "1, 2.5, 3");
/// const double second = value.toReal(1);  // 2.5
/// QPlcMasterNode master;
/// master.setSignalValue("position", value);
/// \endcode
///
/// Values of up to 24 bytes (all scalars, triples) need no heap memory. Larger arrays and texts do.
/// The cycle copies bytes and uses no QPlcValue: use ports (QPlcInput, QPlcOutput) where
/// allocations matter.
///
/// \threadsafe a value type: each thread may use its own object
///
/// \ingroup signals
class QTPLC_EXPORT QPlcValue
{
public:
    /// Makes an invalid value.
    QPlcValue() = default;
    /// Copies a value. A move is a copy, too.
    QPlcValue(const QPlcValue &) = default;  // and so a move is a copy, which is as cheap
    /// Copies a value, with its type.
    QPlcValue &operator=(const QPlcValue &) = default;
    /// Makes the zero of \a type: 0, an empty text, or 1970-01-01. An invalid type gives an invalid
    /// value.
    explicit QPlcValue(QPlcSignalType type);
    /// Makes a single number, or a truth value as Int8 with 0 or 1. The type of the signal follows
    /// the C++ type: `double` gives Real64, `int` gives Int32. A pointer or an enumeration does not
    /// compile.
    template<typename T, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, long double>, int> = 0>
    QPlcValue(T value)
        : QPlcValue(scalarOf<T>(), &value, 1)
    {
    }
    /// Makes an array of the N numbers of \a values. `char` arrays are texts, not numbers.
    template<typename T, std::size_t N, std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, char>, int> = 0>
    QPlcValue(const T (&values)[N])
        : QPlcValue(scalarOf<T>(), values, int(N))
    {
        static_assert(N * sizeof(T) <= QPlcSignalType::MaximumSize,
                      "a signal has at most QPlcSignalType::MaximumSize bytes");
    }
    /// Makes an array of the N numbers of \a values.
    template<typename T, std::size_t N>
    QPlcValue(const std::array<T, N> &values)
        : QPlcValue(scalarOf<T>(), values.data(), int(N))
    {
        static_assert(N > 0 && N * sizeof(T) <= QPlcSignalType::MaximumSize,
                      "a signal has 1 to QPlcSignalType::MaximumSize bytes");
    }
    /// Makes a String with the capacity that \a text needs, at least
    /// QPlcSignalType::DefaultStringCapacity. Invalid when the text has more than 1438 bytes of
    /// UTF-8 or an unpaired surrogate.
    QPlcValue(const QString &text);
    /// Makes a String from UTF-8, as above. Invalid when \a text is not valid UTF-8.
    /// \pre \a text is not null and ends with a zero byte
    QPlcValue(const char *text);
    /// Makes a DateTime in UTC, with the resolution of a QDateTime: 1 ms. Invalid for an invalid
    /// time and outside of the years 1677 to 2262.
    QPlcValue(const QDateTime &time);

    /// Returns the value that the bytes of a frame stand for.
    /// \param bytes  type.size() packed little-endian bytes; they are copied
    /// \return an invalid value for a text that is longer than its capacity or not valid UTF-8
    static QPlcValue fromBytes(QPlcSignalType type, const void *bytes);
    /// Returns the value as above; an invalid value when \a bytes has another size than \a type.
    static QPlcValue fromBytes(QPlcSignalType type, const QByteArray &bytes);
    /// Reads a value that a person types: "1.5", "1, 2, 3", "true", "2026-01-31T12:00:00Z". The
    /// decimal point is '.'. Commas separate the elements of an array; a single number sets all of
    /// them. `nan` and `inf` are numbers of a real type.
    /// \param error  if given: why \a text does not fit and what to write; empty on success
    /// \return an invalid value for text behind a number, a number out of the range of the type,
    ///     the wrong number of elements, or a text that is too long
    static QPlcValue fromString(QPlcSignalType type, const QString &text, QString *error = nullptr);

    /// Returns false for a value without a type.
    bool isValid() const { return m_type.isValid(); }
    /// Returns the type; an invalid type for an invalid value.
    QPlcSignalType type() const { return m_type; }

    /// Returns the type().size() packed little-endian bytes of the value.
    QByteArray toBytes() const;
    /// Writes the type().size() packed little-endian bytes of the value to \a bytes.
    /// \pre \a bytes has room for them
    void toBytes(void *bytes) const;

    /// Returns one element as a number. A time gives nanoseconds since 1970.
    /// \param element  from 0
    /// \param ok  if given: false when there is no such element, or the value is a text or invalid
    /// \return 0 when there is no such element
    double toReal(int element = 0, bool *ok = nullptr) const;
    /// Does the same as toReal(); the name of the thesis.
    double toReal64(int element = 0, bool *ok = nullptr) const { return toReal(element, ok); }
    /// Returns toReal() rounded to 32 bits.
    float toReal32(int element = 0, bool *ok = nullptr) const { return float(toReal(element, ok)); }
    /// Returns one element as an integer of 64 bits. A real number is rounded to the nearest
    /// integer. What is out of range becomes the smallest or largest integer.
    /// \param element  from 0
    /// \param ok  if given: false when there is no such element, or it is NaN or a text
    /// \return 0 when \a ok is false
    qint64 toInt64(int element = 0, bool *ok = nullptr) const;
    /// Returns one element as an unsigned integer of 64 bits, by the rules of toInt64(). Negative
    /// numbers give 0.
    quint64 toUInt64(int element = 0, bool *ok = nullptr) const;
    /// Returns one element as an `int`, by the rules of toInt64().
    int toInt(int element = 0, bool *ok = nullptr) const;
    /// Returns one element as an unsigned `int`, by the rules of toInt64().
    uint toUInt(int element = 0, bool *ok = nullptr) const;
    /// Returns true if the element is a number other than 0; NaN is true, too.
    bool toBool(int element = 0) const { return toReal(element) != 0.0; }
    /// Returns the elements 0, 1 and 2. Elements that do not exist are 0.
    std::array<double, 3> toRealTriple() const { return {toReal(0), toReal(1), toReal(2)}; }
    /// Returns the time in UTC, rounded down to 1 ms; an invalid QDateTime for all other types.
    QDateTime toDateTime() const;
    /// Returns the shortest text that fromString() reads back as the same bits. ", " separates the
    /// elements of an array. Empty for an invalid value.
    QString toString() const;

    /// Returns false if an element of a real value is NaN or infinite; true for all other types.
    bool isFinite() const;
    /// Returns the same quantity as a value of another type: numbers to numbers (element by
    /// element, or one number to all elements), texts to texts that are long enough. Precision may
    /// be lost.
    /// \return an invalid value when the value does not fit: other number of elements, integer out
    ///     of range, NaN to an integer, text too long, number to text
    QPlcValue convertedTo(QPlcSignalType type) const;
    /// Returns the value for models and scripts: a number, a QString, a QDateTime, or a
    /// QVariantList of numbers for an array. An invalid QVariant for an invalid value.
    QVariant toVariant() const;
    /// Returns toVariant().
    operator QVariant() const { return toVariant(); }

    /// Returns true if type and bytes are the same: NaN equals NaN, and -0.0 differs from 0.0.
    friend QTPLC_EXPORT bool operator==(const QPlcValue &a, const QPlcValue &b);
    /// Returns true if type or bytes differ.
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
    Q_DECL_HIDDEN void assignText(const QByteArray &utf8);
    char *data();
    const char *data() const;

    static constexpr int InlineSize = 24;
    QPlcSignalType m_type;
    std::array<char, InlineSize> m_inline{};
    QByteArray m_heap;
};

Q_DECLARE_METATYPE(QPlcValue)

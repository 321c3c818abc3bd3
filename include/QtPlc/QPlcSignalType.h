// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// The type of a signal: a scalar kind and, for arrays and texts, a fixed size.
///
/// A signal never changes its size: a text has a capacity in bytes, an array a number of elements.
/// Values are little-endian and packed. size() is therefore the number of bytes both in the process
/// image and on the wire.
///
/// | name in the table             | scalar                       | size in bytes               |
/// |-------------------------------|------------------------------|-----------------------------|
/// | Int8, Bool; UInt8, Byte       | Int8; UInt8                  | 1                           |
/// | Int16; UInt16                 | Int16; UInt16                | 2                           |
/// | Int32, Int; UInt32, UInt      | Int32; UInt32                | 4                           |
/// | Int64; UInt64                 | Int64; UInt64                | 8                           |
/// | Real32, Real; Real64          | Real32; Real64               | 4; 8                        |
/// | Real32Triple, RealTriple      | Real32, 3 elements           | 12                          |
/// | Real64Triple                  | Real64, 3 elements           | 24                          |
/// | *numeric*[n]                  | as named, n elements         | n times that of one element |
/// | String, String(n)             | String                       | 2 + n (n = 64 by default)   |
/// | DateTime                      | DateTime, ns since 1970 UTC  | 8                           |
///
/// \code
/// QString error;
/// const QPlcSignalType type = QPlcSignalType::fromName("Real32[3]", &error);
/// if (!type.isValid())
///     qWarning("%s", qPrintable(error));
/// const int bytes = type.size();  // 12
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup signals
class QTPLC_EXPORT QPlcSignalType
{
public:
    /// Kind of one element.
    enum Scalar : quint8 {
        Invalid,  ///< no type
        Int8,     ///< signed integer of 8 bits; truth values are 0 and 1
        Int16,    ///< signed integer of 16 bits
        Int32,    ///< signed integer of 32 bits
        Int64,    ///< signed integer of 64 bits
        UInt8,    ///< unsigned integer of 8 bits
        UInt16,   ///< unsigned integer of 16 bits
        UInt32,   ///< unsigned integer of 32 bits
        UInt64,   ///< unsigned integer of 64 bits
        Real32,   ///< IEEE 754 number of 32 bits
        Real64,   ///< IEEE 754 number of 64 bits
        String,   ///< UTF-8 text with a capacity, behind its length of 16 bits
        DateTime  ///< point in time: nanoseconds since 1970-01-01 UTC, 64 bits, signed
    };

    /// Largest size of a signal [byte]: its value has to fit into one datagram.
    static constexpr int MaximumSize = 1440;
    /// Capacity of the type `String` without a size of its own [byte of UTF-8].
    static constexpr int DefaultStringCapacity = 64;

    /// Makes an invalid type.
    constexpr QPlcSignalType() = default;
    /// Makes a type. It is invalid when its values would have more than MaximumSize bytes, and for
    /// an array of times.
    /// \param scalar  kind of one element
    /// \param count  number of elements; of a String the capacity in bytes. 0: one element, or
    ///     DefaultStringCapacity
    constexpr QPlcSignalType(Scalar scalar, int count = 0)
        : m_scalar(exists(scalar, countOf(scalar, count)) ? scalar : Invalid)
        , m_count(m_scalar == Invalid ? quint16(0) : quint16(countOf(scalar, count)))
    {
    }

    /// Returns the type that \a name stands for in a signal table (see the table above). Upper and
    /// lower case matter.
    /// \param error  if given: what is wrong and which known name is close; empty for a valid name
    /// \return an invalid type for a name that is not known or a size that is too large
    static QPlcSignalType fromName(const QString &name, QString *error = nullptr);

    /// Returns false for the invalid type.
    constexpr bool isValid() const { return m_scalar != Invalid; }
    /// Returns the kind of one element.
    constexpr Scalar scalar() const { return m_scalar; }
    /// Returns the number of elements: 1 for single numbers, texts and times; 0 for the invalid
    /// type.
    constexpr int count() const { return m_scalar == String ? 1 : m_count; }
    /// Returns the capacity of a text [byte of UTF-8]; 0 for all other types.
    constexpr int capacity() const { return m_scalar == String ? m_count : 0; }
    /// Returns true for two or more elements.
    constexpr bool isArray() const { return count() > 1; }
    /// Returns true for Real32 and Real64, also as an array.
    constexpr bool isReal() const { return m_scalar == Real32 || m_scalar == Real64; }
    /// Returns true for Int8 to UInt64, also as an array. Truth values are integers; times are not.
    constexpr bool isInteger() const { return m_scalar >= Int8 && m_scalar <= UInt64; }
    /// Returns true for reals and integers, also as an array.
    constexpr bool isNumeric() const { return isReal() || isInteger(); }
    /// Returns true for texts.
    constexpr bool isString() const { return m_scalar == String; }
    /// Returns true for times.
    constexpr bool isDateTime() const { return m_scalar == DateTime; }
    /// Returns the size of one element [byte]; 1 for texts, 0 for the invalid type.
    constexpr int elementSize() const { return elementSize(m_scalar); }
    /// Returns the size of the whole value [byte], in the process image and on the wire; 0 for the
    /// invalid type.
    constexpr int size() const { return m_scalar == String ? 2 + m_count : elementSize() * m_count; }

    /// Returns the canonical name: "Real32", "Real32[3]", "String(64)", or "Invalid". fromName()
    /// reads the name of a valid type back.
    QString name() const;

    /// Returns true if scalar and count (of a text: capacity) are the same.
    friend constexpr bool operator==(QPlcSignalType a, QPlcSignalType b)
    {
        return a.m_scalar == b.m_scalar && a.m_count == b.m_count;
    }
    /// Returns true if scalar or count differ.
    friend constexpr bool operator!=(QPlcSignalType a, QPlcSignalType b) { return !(a == b); }

private:
    static constexpr int elementSize(Scalar scalar)
    {
        constexpr quint8 sizes[] = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1, 8};
        return sizes[scalar];
    }
    static constexpr int countOf(Scalar scalar, int count)
    {
        return count != 0 ? count : scalar == String ? DefaultStringCapacity : 1;
    }
    static constexpr bool exists(Scalar scalar, int count)
    {
        const int space = scalar == String ? MaximumSize - 2 : MaximumSize;
        return scalar > Invalid && scalar <= DateTime && count > 0 && count <= space
            && count * elementSize(scalar) <= space && (scalar != DateTime || count == 1);
    }

    Scalar m_scalar = Invalid;
    quint16 m_count = 0;
};

Q_DECLARE_METATYPE(QPlcSignalType)

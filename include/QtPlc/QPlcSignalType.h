// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// The type of a plc signal: a scalar kind and, for arrays and texts, a fixed size.
///
/// A signal never changes its size: a text has a capacity in bytes, an array a number of elements. Values travel
/// little-endian and packed, so size() is the number of bytes in the process image and on the wire alike.
///
/// | name in the table              | scalar          | size in bytes |
/// |--------------------------------|-----------------|---------------|
/// | Int8, Bool; UInt8, Byte        | Int8; UInt8     | 1             |
/// | Int16; UInt16                  | Int16; UInt16   | 2             |
/// | Int32, Int; UInt32, UInt       | Int32; UInt32   | 4             |
/// | Int64; UInt64                  | Int64; UInt64   | 8             |
/// | Real32, Real; Real64           | Real32; Real64  | 4; 8          |
/// | Real32Triple, RealTriple       | Real32, [3]     | 12            |
/// | Real64Triple                   | Real64, [3]     | 24            |
/// | *numeric*[n]                   | as named, [n]   | n x           |
/// | String, String(n)              | String          | 2 + n (n = 64 unless said) |
/// | DateTime                       | DateTime: ns since 1970-01-01 UTC, Int64 | 8 |
///
/// A value type; thread-safe as such.
class QTPLC_EXPORT QPlcSignalType
{
public:
    enum Scalar : quint8 {
        Invalid,
        Int8,
        Int16,
        Int32,
        Int64,
        UInt8,
        UInt16,
        UInt32,
        UInt64,
        Real32,
        Real64,
        String,
        DateTime
    };

    /// Largest size of one signal in bytes: it has to fit into one datagram.
    static constexpr int MaximumSize = 1440;
    /// Bytes of UTF-8 that a `String` without a capacity of its own holds.
    static constexpr int DefaultStringCapacity = 64;

    constexpr QPlcSignalType() = default;
    /// \param count  number of elements, for String the capacity in bytes; 0: one element, DefaultStringCapacity
    /// An invalid type when the value would have more than MaximumSize bytes, or for an array of times.
    constexpr QPlcSignalType(Scalar scalar, int count = 0)
        : m_scalar(exists(scalar, countOf(scalar, count)) ? scalar : Invalid)
        , m_count(m_scalar == Invalid ? quint16(0) : quint16(countOf(scalar, count)))
    {
    }

    /// The type that \a name stands for in a signal table; an invalid type when there is none, and then \a error (if
    /// given) says what is wrong and which known name comes close.
    static QPlcSignalType fromName(const QString &name, QString *error = nullptr);

    constexpr bool isValid() const { return m_scalar != Invalid; }
    constexpr Scalar scalar() const { return m_scalar; }
    /// Number of elements: 1 for scalars, texts and times.
    constexpr int count() const { return m_scalar == String ? 1 : m_count; }
    /// Capacity of a text in bytes of UTF-8, 0 for other types.
    constexpr int capacity() const { return m_scalar == String ? m_count : 0; }
    constexpr bool isArray() const { return count() > 1; }
    constexpr bool isReal() const { return m_scalar == Real32 || m_scalar == Real64; }
    constexpr bool isInteger() const { return m_scalar >= Int8 && m_scalar <= UInt64; }
    constexpr bool isNumeric() const { return isReal() || isInteger(); }
    constexpr bool isString() const { return m_scalar == String; }
    constexpr bool isDateTime() const { return m_scalar == DateTime; }
    /// Bytes of one element.
    constexpr int elementSize() const { return elementSize(m_scalar); }
    /// Bytes of the whole value.
    constexpr int size() const { return m_scalar == String ? 2 + m_count : elementSize() * m_count; }

    /// The canonical name: "Real32", "Real32[3]", "String(64)".
    QString name() const;

    friend constexpr bool operator==(QPlcSignalType a, QPlcSignalType b)
    {
        return a.m_scalar == b.m_scalar && a.m_count == b.m_count;
    }
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

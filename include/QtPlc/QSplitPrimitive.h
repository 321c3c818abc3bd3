// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/qendian.h>

#include <cstring>

/// A number and its bytes in the byte order of the wire (little-endian) on every machine.
///
/// \code
/// QByteArray bytes = QSplitPrimitive<float>(1.5f).toBytes();
/// float value = QSplitPrimitive<float>::fromBytes(bytes.constData());
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup signals
template<typename T>
union QSplitPrimitive
{
    static_assert(std::is_arithmetic_v<T>, "QSplitPrimitive splits numbers");

    /// Makes an object that holds \a number.
    QSplitPrimitive(T number = T())
        : value(number)
    {
    }

    /// Returns the sizeof(T) bytes of the number, little-endian.
    QByteArray toBytes() const
    {
        QByteArray result(int(sizeof(T)), Qt::Uninitialized);
        toBytes(result.data());
        return result;
    }
    /// Writes the sizeof(T) bytes of the number, little-endian, to \a target.
    /// \pre \a target has room for sizeof(T) bytes
    void toBytes(void *target) const { qToLittleEndian<T>(value, target); }
    /// Returns the number whose sizeof(T) little-endian bytes begin at \a source.
    static T fromBytes(const void *source) { return qFromLittleEndian<T>(source); }

    T value;                         ///< the number
    unsigned char bytes[sizeof(T)];  ///< its bytes in the order of this machine, not of the wire
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/qendian.h>

#include <cstring>

/// A number and its bytes in the byte order of the wire (little-endian) on every machine.
///
/// ```cpp
/// QByteArray bytes = QSplitPrimitive<float>(1.5f).toBytes();
/// float value = QSplitPrimitive<float>::fromBytes(bytes.constData());
/// ```
template<typename T>
union QSplitPrimitive
{
    static_assert(std::is_arithmetic_v<T>, "QSplitPrimitive splits numbers");

    QSplitPrimitive(T number = T())
        : value(number)
    {
    }

    QByteArray toBytes() const
    {
        QByteArray result(int(sizeof(T)), Qt::Uninitialized);
        toBytes(result.data());
        return result;
    }
    void toBytes(void *target) const { qToLittleEndian<T>(value, target); }
    static T fromBytes(const void *source) { return qFromLittleEndian<T>(source); }

    T value;
    unsigned char bytes[sizeof(T)];  ///< in the order of this machine
};

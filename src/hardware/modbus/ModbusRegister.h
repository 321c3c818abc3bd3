// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RawNumber.h"

#include <QtCore/QString>

namespace qplc {

/// Where a value lies in a Modbus device, and what its bits mean: "holding 100, int32, factor 0.1".
struct ModbusRegister
{
    enum Space : quint8 {
        Coil,      ///< a bit, read and written
        Discrete,  ///< a bit, read
        Input,     ///< 16 bits, read
        Holding    ///< 16 bits, read and written
    };
    enum Type : quint8 { Bit, Int16, UInt16, Int32, UInt32, Float32, Int64, Float64 };

    Space space = Holding;
    Type type = UInt16;
    quint8 unit = 1;
    // Bits of an Input or Holding register: the lowest of them (0 ... 15), and how many.
    quint8 bit = 0;
    quint8 bitCount = 1;
    bool isLowWordFirst = false;
    bool isLowByteFirst = false;  // in each word
    quint16 address = 0;          // as on the wire: from 0
    double factor = 1.0;
    double offset = 0.0;

    bool isOfBits() const { return space == Coil || space == Discrete; }
    bool isWritable() const { return space == Coil || space == Holding; }
    /// Whether it is a part of a register, whose other bits belong to others.
    bool isPart() const { return type == Bit && !isOfBits(); }
    /// The bits of a word that belong to it, as on the wire. \pre isPart()
    quint16 mask() const;
    /// How many bits (Coil, Discrete) or registers it takes.
    int size() const;
    RawNumber number() const;

    RawNumber::Limits limits() const;
    /// \param words  size() of them, one for each bit or register
    double decode(const quint16 *words) const;
    /// The nearest value that the type can hold; of a part of a register, with 0 in all other bits.
    void encode(double value, quint16 *words) const;

    /// \param defaults  has what \a text does not say
    /// \return false with the offending text and what would be right in \a error
    static bool parse(const QString &text, const ModbusRegister &defaults, ModbusRegister *result, QString *error);
};

}  // namespace qplc

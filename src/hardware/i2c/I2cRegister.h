// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RawNumber.h"

#include <QtCore/QStringList>

namespace qplc {

/// A number in the registers of a device, as a configuration says it:
/// `0x3b, int16 big-endian, factor 0.001, offset 0, write`.
struct I2cRegister
{
    enum Type : quint8 {
        SignedInteger,
        UnsignedInteger,
        Real  // IEEE 754, 4 bytes
    };
    static constexpr int MostBytes = 4;

    quint8 first = 0;
    Type type = UnsignedInteger;
    int size = 1;  // [byte]
    bool isBigEndian = true;
    double factor = 1.0;  // value = factor * number + offset
    double offset = 0.0;
    bool isWritten = false;

    /// \return an empty text, or what is wrong with \a words, and what would be right
    static QString read(const QStringList &words, I2cRegister *result);

    RawNumber::Limits limits() const;
    double valueOf(const quint8 *bytes) const;
    /// The nearest number that the registers can hold.
    void bytesOf(double value, quint8 *bytes) const;
};

}  // namespace qplc

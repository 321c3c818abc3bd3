// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RawNumber.h"

#include <QtCore/QStringList>

namespace qplc {

/// A number in the registers of a device, as a configuration says it:
/// `0x3b, int16 big-endian, bits 4-15, factor 0.001, offset 0, write`, or `plain, uint16`.
struct DeviceRegister
{
    enum Type : quint8 {
        SignedInteger,
        UnsignedInteger,
        Real  // IEEE 754, 4 bytes
    };
    static constexpr int MostBytes = 4;

    int first = 0;  // or RegisterBus::NoRegister
    Type type = UnsignedInteger;
    int size = 1;  // [byte]
    // Bits of the number that count, 0 is the lowest; bitCount 0: all of them.
    int lowestBit = 0;
    int bitCount = 0;
    bool isBigEndian = true;
    double factor = 1.0;  // value = factor * number + offset
    double offset = 0.0;
    bool isWritten = false;

    /// \return an empty text, or what is wrong with \a words, and what would be right
    static QString read(const QStringList &words, DeviceRegister *result, int lastRegister = 0xff);

    bool isField() const { return bitCount > 0; }
    /// Whether writing both would write a bit twice.
    bool overlaps(const DeviceRegister &other) const;

    RawNumber::Limits limits() const;
    double valueOf(const quint8 *bytes) const;
    /// Writes the nearest number that the registers can hold. Bits of \a bytes outside of the field
    /// keep their values.
    void bytesOf(double value, quint8 *bytes) const;

private:
    QString check(int lastRegister) const;
    RawNumber number() const;
    quint64 join(const quint8 *bytes) const;
};

}  // namespace qplc

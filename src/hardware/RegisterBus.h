// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// One device on a bus, seen as numbered registers of a byte each. A device without registers sends
/// and takes plain bytes: register NoRegister.
///
/// read() and write() wait for the bus; they return false, with errno, when the device does not
/// answer (ENXIO, EREMOTEIO, EIO, ETIMEDOUT) or the bus is gone (ENODEV).
class RegisterBus
{
public:
    /// How long the number of a register is on the wire.
    enum Numbers : quint8 {
        EightBits,   // 0 ... 0xff
        SixteenBits  // 0 ... 0xffff, the high byte first
    };
    static constexpr int NoRegister = -1;
    static constexpr int lastRegister(Numbers numbers) { return numbers == EightBits ? 0xff : 0xffff; }
    /// [byte] that are read in one transaction on every adapter that has blocks
    static constexpr int MostAtOnce = 32;

    RegisterBus() = default;
    virtual ~RegisterBus() = default;
    RegisterBus(const RegisterBus &) = delete;
    RegisterBus &operator=(const RegisterBus &) = delete;

    /// Registers \a first, first + 1, ...; or plain bytes. \param count  at most MostAtOnce
    virtual bool read(int first, quint8 *bytes, int count) noexcept = 0;
    virtual bool write(int first, const quint8 *bytes, int count) noexcept = 0;

    /// "0x68"
    static QString byteText(int number) { return QStringLiteral("0x%1").arg(number, 2, 16, QLatin1Char('0')); }
    /// "register 0x1f", or "plain bytes"
    static QString registerText(int reg)
    {
        return reg == NoRegister ? QStringLiteral("plain bytes") : QStringLiteral("register ") + byteText(reg);
    }
};

}  // namespace qplc

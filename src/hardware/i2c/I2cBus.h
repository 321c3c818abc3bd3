// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <memory>

namespace qplc {

/// One device on an I2C bus, seen as numbered registers of a byte each: `/dev/i2c-N`, or a fake
/// one. A device without registers sends and takes plain bytes: register NoRegister.
///
/// read() and write() wait for the bus; they return false, with errno, when the device does not
/// answer (ENXIO, EREMOTEIO, EIO, ETIMEDOUT) or the bus is gone (ENODEV).
class I2cBus
{
public:
    I2cBus() = default;
    virtual ~I2cBus() = default;
    I2cBus(const I2cBus &) = delete;
    I2cBus &operator=(const I2cBus &) = delete;

    static constexpr int FirstAddress = 0x08;  // those below and above are for the bus itself
    static constexpr int LastAddress = 0x77;

    /// How long the number of a register is on the wire.
    enum Numbers : quint8 {
        EightBits,   // 0 ... 0xff
        SixteenBits  // 0 ... 0xffff, the high byte first
    };
    static constexpr int NoRegister = -1;
    static constexpr int lastRegister(Numbers numbers) { return numbers == EightBits ? 0xff : 0xffff; }
    /// [byte] that are read in one transaction on every adapter that has blocks
    static constexpr int MostAtOnce = 32;

    /// \param device  "/dev/i2c-1", "i2c-1" or "fake:NAME" \param address  7 bits
    /// \return null, with the reason and the remedy in \a error
    static std::unique_ptr<I2cBus> open(const QString &device, int address, QString *error,
                                        Numbers numbers = EightBits);

    /// Registers \a first, first + 1, ...; or plain bytes. \param count  at most MostAtOnce
    virtual bool read(int first, quint8 *bytes, int count) noexcept = 0;
    virtual bool write(int first, const quint8 *bytes, int count) noexcept = 0;
};

/// As I2cBus::open(), for a bus of the kernel.
std::unique_ptr<I2cBus> openKernelI2cBus(const QString &device, int address, QString *error, I2cBus::Numbers numbers);

/// "0x68"
QString i2cAddressText(int address);
/// "register 0x1f", or "plain bytes"
QString i2cRegisterText(int reg);
/// What to do when a device on a bus does not answer, for QPlcDriver::remedy(). Empty for errors
/// that are no errors of the bus.
QString i2cRemedy(int errorNumber);

}  // namespace qplc

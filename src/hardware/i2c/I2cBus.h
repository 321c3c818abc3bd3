// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RegisterBus.h"

#include <memory>

class QPlcDriverSettings;

namespace qplc {

/// One device on an I2C bus: `/dev/i2c-N`, or a fake one.
class I2cBus : public RegisterBus
{
public:
    static constexpr int FirstAddress = 0x08;  // those below and above are for the bus itself
    static constexpr int LastAddress = 0x77;

    /// \param device  "/dev/i2c-1", "i2c-1" or "fake:NAME" \param address  7 bits
    /// \return null, with the reason and the remedy in \a error
    static std::unique_ptr<I2cBus> open(const QString &device, int address, QString *error,
                                        Numbers numbers = EightBits);
};

/// As I2cBus::open(), for a bus of the kernel.
std::unique_ptr<I2cBus> openKernelI2cBus(const QString &device, int address, QString *error, I2cBus::Numbers numbers);

/// Claims an address of the bus \a device (key `address`).
void claimI2cAddress(const QString &device, int address, QPlcDriverSettings &settings);
/// What to do when a device on a bus does not answer, for QPlcDriver::remedy(). Empty for errors
/// that are no errors of the bus.
QString i2cRemedy(int errorNumber);

}  // namespace qplc

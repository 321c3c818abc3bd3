// SPDX-License-Identifier: Apache-2.0
#include "I2cBus.h"

#include "FakeI2cBus.h"

#include <cerrno>

namespace qplc {

std::unique_ptr<I2cBus> I2cBus::open(const QString &device, int address, QString *error, Numbers numbers)
{
    if (FakeMemory::isFake(device))
        return FakeI2cBus::open(device, address, error);
    return openKernelI2cBus(device, address, error, numbers);
}

QString i2cAddressText(int address)
{
    return QStringLiteral("0x%1").arg(address, 2, 16, QLatin1Char('0'));
}

QString i2cRegisterText(int reg)
{
    return reg == I2cBus::NoRegister ? QStringLiteral("plain bytes")
                                     : QStringLiteral("register ") + i2cAddressText(reg);
}

QString i2cRemedy(int errorNumber)
{
    switch (errorNumber) {
    case ENXIO:
    case EREMOTEIO:
    case EIO:
        return QStringLiteral("the device does not answer: look at its power, SDA and SCL, and its address; "
                              "'i2cdetect -y N' shows who answers on bus N");
    case ETIMEDOUT:
        return QStringLiteral("the bus is stuck: SDA or SCL is held low; look at the wires and pull-up resistors, or "
                              "switch the device off and on");
    case EOPNOTSUPP:
        return QStringLiteral("the adapter has only SMBus calls, and so neither plain bytes nor registers of 16 bits; "
                              "take another adapter");
    case EAGAIN:
        return QStringLiteral("another master has the bus");
    case ENODEV:
        return QStringLiteral("the adapter of the bus is gone: plug it in again");
    default:
        return QString();
    }
}

}  // namespace qplc

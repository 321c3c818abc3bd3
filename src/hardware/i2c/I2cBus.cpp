// SPDX-License-Identifier: Apache-2.0
#include "I2cBus.h"

#include "FakeI2cBus.h"
#include "QPlcDriverSettings.h"

#include <cerrno>

namespace qplc {

std::unique_ptr<I2cBus> I2cBus::open(const QString &device, int address, QString *error, Numbers numbers)
{
    if (FakeMemory::isFake(device))
        return FakeI2cBus::open(device, address, error);
    return openKernelI2cBus(device, address, error, numbers);
}

void claimI2cAddress(const QString &device, int address, QPlcDriverSettings &settings)
{
    settings.claim(QStringLiteral("address"),
                   QStringLiteral("address %1 of %2")
                       .arg(RegisterBus::byteText(address), QString(device).remove(QStringLiteral("/dev/"))));
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

// SPDX-License-Identifier: Apache-2.0
#include "I2cBus.h"
#include "QPlcDriverSettings.h"
#include "hardware/Drivers.h"
#include "hardware/RegistersDriver.h"

namespace qplc {

namespace {

/// Kind `i2c-registers`: any I2C device, its registers named by the configuration. See
/// docs/hardware/i2c.md.
class I2cRegistersDriver final : public RegistersDriver
{
public:
    I2cRegistersDriver()
        : RegistersDriver(Acknowledged)
    {
    }

private:
    void configureBus(QPlcDriverSettings &settings) override
    {
        m_bus = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/i2c-1"));
        settings.requiredText(QStringLiteral("address"), QStringLiteral("0x68"));
        m_address = int(settings.integer(QStringLiteral("address"), I2cBus::FirstAddress, I2cBus::FirstAddress,
                                         I2cBus::LastAddress));
        claimI2cAddress(m_bus, m_address, settings);
    }

    std::unique_ptr<RegisterBus> openBus(QString *error) override
    {
        return I2cBus::open(m_bus, m_address, error, numbers());
    }

    QString place() const override
    {
        return QStringLiteral("the device at %1 of %2").arg(RegisterBus::byteText(m_address), m_bus);
    }

    QString remedyOfIdentity() const override { return QStringLiteral("look at 'address' and 'identity'"); }

    QString remedy(int errorNumber) const override
    {
        const QString text = i2cRemedy(errorNumber);
        return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
    }

    QString m_bus;
    int m_address = 0;
};

}  // namespace

std::unique_ptr<QPlcDriver> createI2cRegistersDriver()
{
    return std::make_unique<I2cRegistersDriver>();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "FakeSpiRegisters.h"
#include "QPlcDriverSettings.h"
#include "SpiRegisterBus.h"
#include "hardware/Drivers.h"
#include "hardware/RegistersDriver.h"

#include <cerrno>

namespace qplc {

namespace {

/// Kind `spi-registers`: any SPI device with registers, which are named by the configuration. See
/// docs/hardware/spi.md.
class SpiRegistersDriver final : public RegistersDriver
{
public:
    SpiRegistersDriver()
        : RegistersDriver(Silent)
    {
    }

private:
    void configureBus(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/spidev0.0"));
        settings.claim(QStringLiteral("device"), QStringLiteral("chip at ") + m_device);
        m_settings.speed = quint32(settings.integer(QStringLiteral("speed"), 1000000, 1000, 100000000));
        m_settings.mode = int(settings.integer(QStringLiteral("mode"), 0, 0, 3));
        m_protocol.numbers = numbers();
        const bool isWide = numbers() == RegisterBus::SixteenBits;
        m_protocol.readMask = mask(settings, QStringLiteral("read-mask"), isWide ? 0x8000 : 0x80);
        m_protocol.writeMask = mask(settings, QStringLiteral("write-mask"), 0);
        m_protocol.dummyBytes
            = int(settings.integer(QStringLiteral("dummy-bytes"), 0, 0, SpiRegisterBus::MostDummyBytes));
        if (!settings.has(QStringLiteral("identity")))
            settings.addWarning(
                QString(),
                QStringLiteral("the driver cannot see that the device at %1 is gone: its "
                               "values are 0 or all their bits 1 then; add 'identity = REGISTER VALUE', "
                               "if it has such a register")
                    .arg(m_device));
    }

    int mask(QPlcDriverSettings &settings, const QString &key, int usual) const
    {
        return int(settings.integer(key, usual, 0, RegisterBus::lastRegister(numbers())));
    }

    std::unique_ptr<RegisterBus> openBus(QString *error) override
    {
        std::unique_ptr<SpiBus> bus;
        if (FakeMemory::isFake(m_device))
            bus = FakeSpiRegisters::open(m_device, error);
        else
            bus = SpiBus::open(m_device, m_settings, error);
        return bus ? std::make_unique<SpiRegisterBus>(std::move(bus), m_protocol) : nullptr;
    }

    QString place() const override { return QStringLiteral("the device at %1").arg(m_device); }
    QString remedyOfIdentity() const override
    {
        return QStringLiteral("look at its power, at MISO and chip select, and at 'mode', 'read-mask' and 'identity'");
    }

    QString remedy(int errorNumber) const override
    {
        if (errorNumber == ENODEV)
            return QStringLiteral("the bus is gone: plug its adapter in again");
        return QPlcDriver::remedy(errorNumber);
    }

    QString m_device;
    SpiSettings m_settings;
    SpiRegisterBus::Protocol m_protocol;
};

}  // namespace

std::unique_ptr<QPlcDriver> createSpiRegistersDriver()
{
    return std::make_unique<SpiRegistersDriver>();
}

}  // namespace qplc

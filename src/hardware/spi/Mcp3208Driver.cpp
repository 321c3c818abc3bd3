// SPDX-License-Identifier: Apache-2.0
#include "FakeMcp3208.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "SpiBus.h"
#include "hardware/Drivers.h"

#include <cerrno>

namespace qplc {

namespace {

constexpr double Mcp3208Steps = 4096.0;
constexpr quint8 Mcp3208NullBit = 0x10;  // of the second byte: 0 before the first bit of the result

/// Kind `mcp3208`: converter MCP3208, 8 voltages with 12 bits, alone or as differences of
/// neighbours. See docs/hardware/spi.md.
class Mcp3208Driver final : public QPlcDriver
{
public:
    static constexpr int Inputs = 8;

    Mcp3208Driver()
        : QPlcDriver(OwnPace)
    {
        for (int i = 0; i < Inputs; ++i) {
            m_voltages[i] = std::make_unique<QPlcReadChannel>(this, QStringLiteral("voltage%1").arg(i));
            m_differences[i]
                = std::make_unique<QPlcReadChannel>(this, QStringLiteral("difference%1%2").arg(i).arg(i ^ 1));
        }
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/spidev0.0"));
        settings.claim(QStringLiteral("device"), QStringLiteral("chip at ") + m_device);
        m_reference = settings.number(QStringLiteral("reference"), 3.3, 0.25, 5.5);
        m_settings.speed = quint32(settings.integer(QStringLiteral("speed"), 1000000, 10000, 2000000));
        // The chip knows the two modes in which data is taken at a rising edge of the clock.
        m_settings.mode
            = settings.choice(QStringLiteral("mode"), {QStringLiteral("0"), QStringLiteral("3")}) == 1 ? 3 : 0;
    }

    bool open() override
    {
        QString error;
        if (FakeMemory::isFake(m_device))
            m_bus = FakeMcp3208::open(m_device, &error);
        else
            m_bus = SpiBus::open(m_device, m_settings, &error);
        return m_bus || fail(error);
    }

    void close() override { m_bus.reset(); }
    bool read() override
    {
        for (int i = 0; i < Inputs; ++i) {
            if (!convert(true, i, m_voltages[i].get()) || !convert(false, i, m_differences[i].get()))
                return false;
        }
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        if (errorNumber == ENODEV)
            return QStringLiteral("the bus is gone: plug its adapter in again");
        return QPlcDriver::remedy(errorNumber);
    }

private:
    bool convert(bool isSingle, int input, QPlcReadChannel *channel)
    {
        if (!channel->isWired())
            return true;
        // Start bit, single-ended, 3 bits of the input; placed so that the result ends with the
        // third byte.
        const quint8 question[] = {quint8(0x04 | (isSingle ? 0x02 : 0) | input >> 2), quint8((input & 3) << 6), 0};
        quint8 answer[sizeof question] = {};
        if (!m_bus->transfer(question, answer, sizeof question))
            return fail(QStringLiteral("cannot talk to the MCP3208 at %1: %2; %3")
                            .arg(m_device, qt_error_string(errno), remedy(errno)));
        if (answer[1] & Mcp3208NullBit)
            return fail(
                QStringLiteral("no MCP3208 answers at %1: its data line stays high; look at its power, at MISO and "
                               "chip select, and at 'device' (the second number is the chip select)")
                    .arg(m_device));
        channel->set(m_reference * ((answer[1] & 0x0f) << 8 | answer[2]) / Mcp3208Steps);
        return true;
    }

    QString m_device;
    SpiSettings m_settings;
    double m_reference = 0.0;  // [V]
    std::unique_ptr<SpiBus> m_bus;
    std::unique_ptr<QPlcReadChannel> m_voltages[Inputs];  // against ground [V]
    std::unique_ptr<QPlcReadChannel>
        m_differences[Inputs];  // of an input against its neighbour: 0 - 1, 1 - 0, 2 - 3, ... [V]
};

}  // namespace

std::unique_ptr<QPlcDriver> createMcp3208Driver()
{
    return std::make_unique<Mcp3208Driver>();
}

}  // namespace qplc

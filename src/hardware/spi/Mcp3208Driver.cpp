// SPDX-License-Identifier: Apache-2.0
#include "Mcp3208Driver.h"

#include "FakeMcp3208.h"
#include "QPlcDriverSettings.h"

#include <cerrno>

namespace qplc {

namespace {

constexpr double Mcp3208Steps = 4096.0;
constexpr quint8 Mcp3208NullBit = 0x10;  // of the second byte: 0 before the first bit of the result

}  // namespace

Mcp3208Driver::Mcp3208Driver()
    : QPlcDriver(OwnPace)
{
    for (int i = 0; i < Inputs; ++i) {
        m_voltages[i] = std::make_unique<QPlcReadChannel>(this, QStringLiteral("voltage%1").arg(i));
        m_differences[i] = std::make_unique<QPlcReadChannel>(this, QStringLiteral("difference%1%2").arg(i).arg(i ^ 1));
    }
}

void Mcp3208Driver::configure(QPlcDriverSettings &settings)
{
    m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/spidev0.0"));
    m_reference = settings.number(QStringLiteral("reference"), 3.3, 0.25, 5.5);
    m_settings.speed = quint32(settings.integer(QStringLiteral("speed"), 1000000, 10000, 2000000));
    // The chip knows the two modes in which data is taken at a rising edge of the clock.
    m_settings.mode = settings.choice(QStringLiteral("mode"), {QStringLiteral("0"), QStringLiteral("3")}) == 1 ? 3 : 0;
}

bool Mcp3208Driver::open()
{
    QString error;
    if (FakeMemory::isFake(m_device))
        m_bus = FakeMcp3208::open(m_device, &error);
    else
        m_bus = SpiBus::open(m_device, m_settings, &error);
    return m_bus || fail(error);
}

bool Mcp3208Driver::read()
{
    for (int i = 0; i < Inputs; ++i) {
        if (!convert(true, i, m_voltages[i].get()) || !convert(false, i, m_differences[i].get()))
            return false;
    }
    return true;
}

bool Mcp3208Driver::convert(bool isSingle, int input, QPlcReadChannel *channel)
{
    if (!channel->isWired())
        return true;
    // Start bit, single-ended, 3 bits of the input; placed so that the result ends with the third
    // byte.
    const quint8 question[] = {quint8(0x04 | (isSingle ? 0x02 : 0) | input >> 2), quint8((input & 3) << 6), 0};
    quint8 answer[sizeof question] = {};
    if (!m_bus->transfer(question, answer, sizeof question))
        return fail(QStringLiteral("cannot talk to the MCP3208 at %1: %2; %3")
                        .arg(m_device, qt_error_string(errno), remedy(errno)));
    if (answer[1] & Mcp3208NullBit)
        return fail(QStringLiteral("no MCP3208 answers at %1: its data line stays high; look at its power, at MISO and "
                                   "chip select, and at 'device' (the second number is the chip select)")
                        .arg(m_device));
    channel->set(m_reference * ((answer[1] & 0x0f) << 8 | answer[2]) / Mcp3208Steps);
    return true;
}

QString Mcp3208Driver::remedy(int errorNumber) const
{
    if (errorNumber == ENODEV)
        return QStringLiteral("the bus is gone: plug its adapter in again");
    return QPlcDriver::remedy(errorNumber);
}

}  // namespace qplc

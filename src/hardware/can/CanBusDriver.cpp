// SPDX-License-Identifier: Apache-2.0
#include "CanBusDriver.h"

#include "QPlcDriverSettings.h"

#include <cerrno>

namespace qplc {

namespace {

constexpr qint64 canRestartTime = 1'000'000'000;  // [ns] that a controller has to come back by itself

}  // namespace

void CanBusDriver::makeBus(const QString &device, QPlcDriverSettings &settings)
{
    QString error;
    m_device = device;
    if (!device.isEmpty())
        m_bus = CanBus::make(device, &error);
    if (!error.isEmpty())
        settings.addError(QStringLiteral("device"), error);
    m_receiveText = "receive from " + device.toLocal8Bit();
    m_sendText = "send to " + device.toLocal8Bit();
}

bool CanBusDriver::openBus(const CanBus::Options &options)
{
    m_busOffSince = -1;
    return m_bus->open(options) || fail(m_bus->errorString());
}

QString CanBusDriver::remedy(int errorNumber) const
{
    switch (errorNumber) {
    case ENETDOWN:
        return QStringLiteral(
                   "the interface is down or bus-off; check wires, terminators and bit rate, and bring it up as "
                   "root (ip link set %1 up type can bitrate 500000 restart-ms 100)")
            .arg(m_device);
    case ENODEV:
    case ENXIO:
        return QStringLiteral("the adapter is gone; plug it in again");
    case EIO:
        return QStringLiteral(
            "for a second the adapter reported only errors, and the log has the last one; check wires, "
            "terminators and bit rate, and plug it in again");
    default:
        return QPlcDriver::remedy(errorNumber);
    }
}

// ---- channels ----

void CanBusDriver::addOwn(const char *name, std::function<quint64()> number)
{
    m_own.push_back({name, std::move(number), nullptr});
}

QStringList CanBusDriver::ownNames() const
{
    QStringList names;
    for (const Own &own : m_own)
        names << QLatin1String(own.name);
    return names;
}

QPlcChannel *CanBusDriver::ownChannel(const QString &name)
{
    for (Own &own : m_own) {
        if (name != QLatin1String(own.name))
            continue;
        if (!own.channel)
            own.channel = std::make_unique<QPlcReadChannel>(this, name);
        return own.channel.get();
    }
    return nullptr;
}

// ---- the cycle ----

void CanBusDriver::showOwn() noexcept
{
    for (const Own &own : m_own) {
        if (own.channel)
            own.channel->set(double(own.number()), now());
    }
}

bool CanBusDriver::send(const CanFrame *frames, int count, int *sent) noexcept
{
    const int taken = m_bus->send(frames, count, now());
    if (sent)
        *sent = taken;
    return taken >= 0 || fail(m_sendText.constData(), m_bus->errorNumber());
}

bool CanBusDriver::checkBusOff() noexcept
{
    if (m_bus->state() != CanBus::BusOff) {
        m_busOffSince = -1;
        return true;
    }
    if (m_busOffSince < 0)
        m_busOffSince = now();
    return now() - m_busOffSince < canRestartTime || fail(m_receiveText.constData(), ENETDOWN);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "QPlcDriver.h"

#include "NotedEvents.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

QPlcDriver::QPlcDriver(Pace pace)
    : m_pace(pace)
    , m_interval(std::chrono::milliseconds(10))
    , m_timeout(std::chrono::milliseconds(100))
    , m_events(std::make_unique<qplc::NotedEvents>())
{
}

QPlcDriver::~QPlcDriver() = default;

QPlcChannel *QPlcDriver::channel(const QString &name, QPlcChannel::Direction direction, QString *error)
{
    Q_UNUSED(error)
    const auto found = std::find_if(m_channels.begin(), m_channels.end(), [&](const QPlcChannel *channel) {
        return channel->direction() == direction && channel->name() == name;
    });
    return found == m_channels.end() ? nullptr : *found;
}

QStringList QPlcDriver::channelNames(QPlcChannel::Direction direction) const
{
    QStringList names;
    for (const QPlcChannel *channel : m_channels) {
        if (channel->direction() == direction)
            names << channel->name();
    }
    return names;
}

// ---- events ----

bool QPlcDriver::noteEvent(quint64 data) noexcept
{
    return m_events->note(data);
}

QPlcDeviceEvent QPlcDriver::describeEvent(quint64 data) const
{
    QPlcDeviceEvent event;
    event.text = QStringLiteral("device '%1' tells the event %2").arg(m_name).arg(data);
    return event;
}

QString QPlcDriver::undeliveredText() const
{
    return QStringLiteral("it does not confirm them; check its power and wires");
}

// ---- errors ----

QString QPlcDriver::errorString() const
{
    if (!m_operation)
        return m_errorText;
    const QString what = QStringLiteral("%1: %2").arg(QLatin1String(m_operation),
                                                      QString::fromLocal8Bit(std::strerror(m_errorNumber)));
    const QString cure = remedy(m_errorNumber);
    return cure.isEmpty() ? what : QStringLiteral("%1; %2").arg(what, cure);
}

QString QPlcDriver::remedy(int errorNumber) const
{
    switch (errorNumber) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return QStringLiteral("is it plugged in and switched on, and is its name right?");
    case EACCES:
    case EPERM:
        return QStringLiteral(
            "put the user of this program into the group of the device (ls -l shows it), and log in again");
    case EBUSY:
        return QStringLiteral("another program uses it; end that one");
    case ENETDOWN:
        return QStringLiteral("the interface is down; bring it up (ip link set ... up)");
    case EIO:
    case EREMOTEIO:
    case ETIMEDOUT:
        return QStringLiteral("the device does not answer: look at its power, its wires and its address");
    default:
        return {};
    }
}

bool QPlcDriver::fail(const QString &text)
{
    m_operation = nullptr;
    m_errorText = text;
    return false;
}

bool QPlcDriver::fail(const char *operation, int errorNumber) noexcept
{
    m_operation = operation;
    m_errorNumber = errorNumber;
    return false;
}

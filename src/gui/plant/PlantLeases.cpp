// SPDX-License-Identifier: Apache-2.0
#include "PlantLeases.h"

#include "node/Logging.h"

#include <QtCore/QRandomGenerator>
#include <QtCore/QSysInfo>

#include <algorithm>

#include <pwd.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int longestName = 64;  // [characters] of the protocol

}  // namespace

QString PlantLeases::whoever()
{
    const passwd *entry = getpwuid(geteuid());
    const QString user = entry ? QString::fromLocal8Bit(entry->pw_name) : QString::number(geteuid());
    return QStringLiteral("%1@%2").arg(user, QSysInfo::machineHostName()).left(longestName);
}

PlantLeases::PlantLeases(ControlClient &control, QObject *parent)
    : QObject(parent)
    , m_control(control)
{
    m_heartbeat.setInterval(HeartbeatPeriod);
    connect(&m_heartbeat, &QTimer::timeout, this,
            [this] { m_control.request(messages::GetState(), [](const auto &) {}); });
}

void PlantLeases::begin(bool hasFeature)
{
    m_hasFeature = hasFeature;
    // Lists tell names, and a person may have two windows, or a connection that the master has not
    // missed yet. So each connection has a timeout of its own: it differs by less than a
    // millisecond.
    m_timeout
        = std::chrono::milliseconds(Timeout) + std::chrono::nanoseconds(QRandomGenerator::global()->bounded(1'000'000));
    if (hasFeature)
        m_control.request(messages::GetLeases(), [this](const ControlClient::Reply<messages::GetLeases> &reply) {
            if (const auto *leases = std::get_if<messages::Leases>(&reply))
                handle(leases->leases);
        });
}

void PlantLeases::end()
{
    m_hasFeature = false;
    setLeases({});
}

messages::TakeLease PlantLeases::wish(const QStringList &signalNames) const
{
    messages::TakeLease wish;
    wish.signals = signalNames;
    wish.whoever = whoever();
    wish.timeout = m_timeout;
    return wish;
}

std::optional<LeaseStatus> PlantLeases::find(const QString &signal) const
{
    const auto found = std::find_if(m_leases.begin(), m_leases.end(),
                                    [&](const LeaseStatus &lease) { return lease.signal == signal; });
    return found == m_leases.end() ? std::nullopt : std::make_optional(*found);
}

void PlantLeases::handle(const std::vector<messages::LeaseEntry> &entries)
{
    QVector<LeaseStatus> leases;
    for (const messages::LeaseEntry &entry : entries) {
        const bool isMine = entry.lease == messages::LeaseState::Held && entry.timeout == m_timeout;
        leases.append({printable(entry.signal), printable(entry.holder), entry.lease, isMine});
    }
    setLeases(leases);
}

void PlantLeases::setLeases(const QVector<LeaseStatus> &leases)
{
    const bool holdsAny
        = std::any_of(leases.begin(), leases.end(), [](const LeaseStatus &lease) { return lease.isMine; });
    if (!holdsAny)
        m_heartbeat.stop();
    else if (!m_heartbeat.isActive())
        m_heartbeat.start();
    if (leases == m_leases)
        return;
    m_leases = leases;
    Q_EMIT changed();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "ConnectionGate.h"

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

/// What counts as one address: in IPv6 a whole network, whose addresses a single computer can use
/// one after the other.
QHostAddress originOf(const QHostAddress &address)
{
    bool isV4 = false;
    const quint32 v4 = address.toIPv4Address(&isV4);
    if (isV4)
        return QHostAddress(v4);
    Q_IPV6ADDR v6 = address.toIPv6Address();
    std::fill(std::begin(v6.c) + 8, std::end(v6.c), quint8(0));
    return QHostAddress(v6);
}

}  // namespace

std::optional<ConnectionGate::Ticket> ConnectionGate::admit(const QHostAddress &address, qint64 now, Refusal *refusal)
{
    const bool isLocal = address.isLoopback();
    const QHostAddress origin = originOf(address);
    *refusal = Admitted;
    if (connections() >= m_limits.connections)
        *refusal = TooManyConnections;
    else if (!isLocal && strangersOf(origin) >= m_limits.strangersOfAddress)
        *refusal = TooManyOfAddress;
    else if (!isLocal && !m_accepts.take(now))
        *refusal = TooFast;
    if (*refusal != Admitted)
        return std::nullopt;
    m_guests.insert(++m_last, {origin, QString(), true, now + m_limits.patience});
    return m_last;
}

void ConnectionGate::renew(Ticket ticket, qint64 now)
{
    const auto guest = m_guests.find(ticket);
    if (guest != m_guests.end())
        guest->deadline = now + m_limits.patience;
}

bool ConnectionGate::prove(Ticket ticket, const QString &identity)
{
    const auto guest = m_guests.find(ticket);
    const auto isIt = [&](const Guest &other) { return other.identity == identity; };
    if (guest == m_guests.end()
        || std::count_if(m_guests.begin(), m_guests.end(), isIt) >= m_limits.connectionsOfIdentity)
        return false;
    guest->identity = identity;
    return true;
}

void ConnectionGate::know(Ticket ticket)
{
    const auto guest = m_guests.find(ticket);
    if (guest != m_guests.end())
        guest->isStranger = false;
}

void ConnectionGate::leave(Ticket ticket)
{
    m_guests.remove(ticket);
}

QVector<ConnectionGate::Ticket> ConnectionGate::overdue(qint64 now) const
{
    QVector<Ticket> tickets;
    for (auto guest = m_guests.begin(); guest != m_guests.end(); ++guest) {
        if (guest->isStranger && now >= guest->deadline)
            tickets << guest.key();
    }
    std::sort(tickets.begin(), tickets.end());
    return tickets;
}

int ConnectionGate::strangers() const
{
    return int(std::count_if(m_guests.begin(), m_guests.end(), [](const Guest &guest) { return guest.isStranger; }));
}

const char *ConnectionGate::textOf(Refusal refusal)
{
    switch (refusal) {
    case Admitted:
        return "";
    case TooManyConnections:
        return "too many connections";
    case TooManyOfAddress:
        return "too many connections of this address that have not said who they are";
    case TooManyOfIdentity:
        return "too many connections of this identity";
    case TooFast:
        return "too many new connections in a short time";
    }
    return "";
}

int ConnectionGate::strangersOf(const QHostAddress &origin) const
{
    return int(std::count_if(m_guests.begin(), m_guests.end(),
                             [&](const Guest &guest) { return guest.isStranger && guest.origin == origin; }));
}

}  // namespace qplc

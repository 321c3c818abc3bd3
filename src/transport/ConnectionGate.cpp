// SPDX-License-Identifier: Apache-2.0
#include "ConnectionGate.h"

#include <algorithm>

namespace qplc {

std::optional<ConnectionGate::Ticket> ConnectionGate::admit(const QHostAddress &address, qint64 now, Refusal *refusal)
{
    const bool isLocal = address.isLoopback();
    *refusal = Admitted;
    if (connections() >= m_limits.connections)
        *refusal = TooManyConnections;
    else if (!isLocal && strangersOf(address) >= m_limits.strangersOfAddress)
        *refusal = TooManyOfAddress;
    else if (!isLocal && !takeToken(now))
        *refusal = TooFast;
    if (*refusal != Admitted)
        return std::nullopt;
    m_guests.insert(++m_last, {address, true, now + m_limits.patience});
    ++m_strangers;
    return m_last;
}

void ConnectionGate::renew(Ticket ticket, qint64 now)
{
    const auto guest = m_guests.find(ticket);
    if (guest != m_guests.end())
        guest->deadline = now + m_limits.patience;
}

void ConnectionGate::know(Ticket ticket)
{
    const auto guest = m_guests.find(ticket);
    if (guest == m_guests.end() || !guest->isStranger)
        return;
    guest->isStranger = false;
    --m_strangers;
}

void ConnectionGate::leave(Ticket ticket)
{
    know(ticket);
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

const char *ConnectionGate::textOf(Refusal refusal)
{
    switch (refusal) {
    case Admitted:
        return "";
    case TooManyConnections:
        return "too many connections";
    case TooManyOfAddress:
        return "too many connections of this address that have not said who they are";
    case TooFast:
        return "too many new connections in a short time";
    }
    return "";
}

int ConnectionGate::strangersOf(const QHostAddress &address) const
{
    return int(std::count_if(m_guests.begin(), m_guests.end(),
                             [&](const Guest &guest) { return guest.isStranger && guest.address.isEqual(address); }));
}

bool ConnectionGate::takeToken(qint64 now)
{
    const qint64 token = 1'000'000'000 / m_limits.acceptsPerSecond;
    const qint64 full = token * m_limits.acceptsAtOnce;
    m_filled = m_isFilled ? std::min(full, m_filled + (now - m_filledAt)) : full;
    m_isFilled = true;
    m_filledAt = now;
    if (m_filled < token)
        return false;
    m_filled -= token;
    return true;
}

}  // namespace qplc

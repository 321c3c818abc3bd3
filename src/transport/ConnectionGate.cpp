// SPDX-License-Identifier: Apache-2.0
#include "ConnectionGate.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr qint64 LongestMemory = 4'000'000'000;  // of the budgets of an address that is not here [ns]

QByteArray bytesOf(const QHostAddress &address)
{
    bool isV4 = false;
    const quint32 v4 = address.toIPv4Address(&isV4);
    if (isV4)
        return QByteArray(reinterpret_cast<const char *>(&v4), sizeof v4);
    const Q_IPV6ADDR v6 = address.toIPv6Address();
    return QByteArray(reinterpret_cast<const char *>(&v6), sizeof v6) + address.scopeId().toUtf8();
}

}  // namespace

ConnectionGate::Admission ConnectionGate::admit(const QHostAddress &address, qint64 now)
{
    const QByteArray key = bytesOf(address);
    Origin &origin = originOf(address, key, now);
    if (known() >= m_limits.connections)
        return {0, TooManyConnections, 0};
    if (!origin.isLocal && !origin.accepts.take(now))
        return {0, TooFast, 0};
    Admission admission;
    if (!origin.isLocal && origin.strangers >= m_limits.strangersOfAddress)
        admission.crowdedOut = leastOf([&](const Visit &visit) { return visit.origin == key; });
    else if (m_strangers >= m_limits.strangers + (origin.isTrusted ? m_limits.reserve : 0)) {
        admission.crowdedOut
            = leastOf([&](const Visit &visit) { return visit.origin == key || !isProtected(visit.origin); });
        if (admission.crowdedOut == 0)
            return {0, TooManyConnections, 0};
    }
    ++origin.strangers;
    ++m_strangers;
    admission.ticket = ++m_last;
    m_visits.insert(admission.ticket, {key, QString(), true, 0, now + m_limits.patience});
    return admission;
}

bool ConnectionGate::hear(Ticket ticket, qint64 now)
{
    const auto visit = m_visits.find(ticket);
    if (visit == m_visits.end())
        return false;
    ++visit->steps;
    const auto origin = m_origins.find(visit->origin);  // kept: a stranger of it is here
    return origin == m_origins.end() || origin->isLocal || origin->handshakes.take(now);
}

void ConnectionGate::renew(Ticket ticket, qint64 now)
{
    const auto visit = m_visits.find(ticket);
    if (visit == m_visits.end())
        return;
    visit->deadline = now + m_limits.patience;
    ++visit->steps;
}

bool ConnectionGate::prove(Ticket ticket, const QString &identity)
{
    const auto visit = m_visits.find(ticket);
    const auto isIt = [&](const Visit &other) { return other.identity == identity; };
    if (visit == m_visits.end()
        || std::count_if(m_visits.begin(), m_visits.end(), isIt) >= m_limits.connectionsOfIdentity)
        return false;
    visit->identity = identity;
    return true;
}

void ConnectionGate::trust(Ticket ticket)
{
    const auto visit = m_visits.constFind(ticket);
    if (visit == m_visits.constEnd())
        return;
    const auto origin = m_origins.find(visit->origin);
    const auto areTrusted = [](const Origin &one) { return one.isTrusted; };
    if (origin != m_origins.end() && std::count_if(m_origins.begin(), m_origins.end(), areTrusted) < MostOrigins / 2)
        origin->isTrusted = true;
}

bool ConnectionGate::know(Ticket ticket, Guest guest)
{
    const auto visit = m_visits.find(ticket);
    const int places = m_limits.connections - (guest == Observer ? m_limits.reserved() : 0);
    if (visit == m_visits.end() || (visit->isStranger && known() >= places))
        return false;
    endStranger(&*visit);
    return true;
}

void ConnectionGate::leave(Ticket ticket)
{
    const auto visit = m_visits.find(ticket);
    if (visit == m_visits.end())
        return;
    endStranger(&*visit);
    m_visits.erase(visit);
}

void ConnectionGate::endStranger(Visit *visit)
{
    if (!visit->isStranger)
        return;
    visit->isStranger = false;
    --m_strangers;
    const auto origin = m_origins.find(visit->origin);
    if (origin != m_origins.end())
        --origin->strangers;
}

QVector<ConnectionGate::Ticket> ConnectionGate::overdue(qint64 now) const
{
    QVector<Ticket> tickets;
    for (auto visit = m_visits.begin(); visit != m_visits.end(); ++visit) {
        if (visit->isStranger && now >= visit->deadline)
            tickets << visit.key();
    }
    std::sort(tickets.begin(), tickets.end());
    return tickets;
}

/// The stranger who has done the fewest steps, and of those the oldest. 0: there is none.
ConnectionGate::Ticket ConnectionGate::leastOf(const std::function<bool(const Visit &)> &isMeant) const
{
    auto least = m_visits.end();
    for (auto visit = m_visits.begin(); visit != m_visits.end(); ++visit) {
        if (visit->isStranger && isMeant(*visit)
            && (least == m_visits.end()
                || std::make_pair(visit->steps, visit.key()) < std::make_pair(least->steps, least.key())))
            least = visit;
    }
    return least == m_visits.end() ? 0 : least.key();
}

// ---- addresses ----

ConnectionGate::Origin &ConnectionGate::originOf(const QHostAddress &address, const QByteArray &key, qint64 now)
{
    auto origin = m_origins.find(key);
    if (origin == m_origins.end()) {
        if (m_origins.size() >= MostOrigins)
            forgetOrigins(now - LongestMemory);
        if (m_origins.size() >= MostOrigins)
            forgetOrigins(now);
        origin = m_origins.insert(key,
                                  {TokenBucket(m_limits.acceptsPerSecond, m_limits.acceptsAtOnce),
                                   TokenBucket(m_limits.handshakesPerSecond, m_limits.handshakesAtOnce),
                                   address.isLoopback(), 0, false, 0});
    }
    origin->seen = now;
    return *origin;
}

/// Whether strangers of others cannot take the places of its own ones: not if these are a crowd.
bool ConnectionGate::isProtected(const QByteArray &origin) const
{
    const auto found = m_origins.constFind(origin);
    return found != m_origins.constEnd() && found->isTrusted && found->strangers <= m_limits.strangersOfAddress;
}

/// Those that are neither here nor trusted, and were not seen after \a before: fewer than
/// MostOrigins stay.
void ConnectionGate::forgetOrigins(qint64 before)
{
    for (auto origin = m_origins.begin(); origin != m_origins.end();) {
        const bool isNeeded = origin->strangers > 0 || origin->isTrusted || origin->seen > before;
        origin = isNeeded ? std::next(origin) : m_origins.erase(origin);
    }
}

const char *ConnectionGate::textOf(Refusal refusal)
{
    switch (refusal) {
    case Admitted:
        return "";
    case TooManyConnections:
        return "too many connections";
    case TooManyOfIdentity:
        return "too many connections of this identity";
    case TooFast:
        return "too many new connections in a short time";
    case TooManyHandshakes:
        return "too many TLS handshakes of this address in a short time";
    }
    return "";
}

}  // namespace qplc

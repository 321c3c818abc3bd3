// SPDX-License-Identifier: Apache-2.0
#include "Leases.h"

namespace qplc {

void Leases::take(const Signals &signals, Holder holder, const QString &name, std::int64_t timeout, std::int64_t now)
{
    for (const QPlcSignalIndex signal : signals)
        m_leases[signal] = {holder, name, timeout, std::make_shared<LeaseTerm>(now + timeout)};
}

void Leases::release(const Signals &signals)
{
    for (const QPlcSignalIndex signal : signals)
        m_leases.erase(signal);
}

void Leases::renew(Holder holder, std::int64_t now)
{
    for (auto &[signal, lease] : m_leases) {
        if (lease.holder == holder)
            lease.term->renew(now, now + lease.timeout);
    }
}

Leases::Signals Leases::loseSilent(std::int64_t now)
{
    return lose([now](const Lease &lease) { return lease.term->deadline() <= now; });
}

Leases::Signals Leases::loseAllOf(Holder holder)
{
    return lose([holder](const Lease &lease) { return lease.holder == holder; });
}

template<typename Predicate>
Leases::Signals Leases::lose(Predicate isLost)
{
    Signals lost;
    for (auto &[signal, lease] : m_leases) {
        if (lease.isLost() || !isLost(lease))
            continue;
        lease.holder = nullptr;
        lost.push_back(signal);
    }
    return lost;
}

const Leases::Lease *Leases::find(QPlcSignalIndex signal) const
{
    const auto found = m_leases.find(signal);
    return found == m_leases.end() ? nullptr : &found->second;
}

bool Leases::isHeldBy(QPlcSignalIndex signal, Holder holder) const
{
    const Lease *lease = find(signal);
    return lease && !lease->isLost() && lease->holder == holder;
}

bool Leases::isHeldByOther(QPlcSignalIndex signal, Holder holder) const
{
    const Lease *lease = find(signal);
    return lease && !lease->isLost() && lease->holder != holder;
}

Leases::Signals Leases::signalsOf(Holder holder) const
{
    Signals held;
    for (const auto &[signal, lease] : m_leases) {
        if (isHeldBy(signal, holder))
            held.push_back(signal);
    }
    return held;
}

std::optional<std::int64_t> Leases::nextDeadline() const
{
    std::optional<std::int64_t> next;
    for (const auto &[signal, lease] : m_leases) {
        if (!lease.isLost() && (!next || lease.term->deadline() < *next))
            next = lease.term->deadline();
    }
    return next;
}

std::vector<bool> Leases::mask() const
{
    if (m_leases.empty())
        return {};
    std::vector<bool> held(std::size_t(m_leases.rbegin()->first) + 1);
    for (const auto &[signal, lease] : m_leases)
        held[signal] = true;
    return held;
}

std::vector<Roster::HeldTerm> Leases::terms() const
{
    std::vector<Roster::HeldTerm> terms;
    terms.reserve(m_leases.size());
    for (const auto &[signal, lease] : m_leases)
        terms.push_back({signal, lease.term});
    return terms;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "Evictions.h"

#include "realtime/TimeSource.h"

namespace qplc {

bool Evictions::add(const QString &name, const QString &by, Role role)
{
    if (!contains(name) && m_evicted.size() >= Most)
        return false;
    m_evicted.insert(name, {by, role, quint64(wallClockNow())});
    return true;
}

QVector<messages::EvictedEntry> Evictions::entries() const
{
    QVector<messages::EvictedEntry> entries;
    for (auto each = m_evicted.begin(); each != m_evicted.end(); ++each)
        entries.append({each.key(), each->by, each->time});
    return entries;
}

Refusal Evictions::refusalOf(const QString &name, const Peer &peer) const
{
    for (const QString &each : {name, peer.provenIdentity()}) {
        const auto found = m_evicted.find(each);
        if (found == m_evicted.end())
            continue;
        const bool isEngineer = peer.isSecured && peer.role == Role::Engineer && each == peer.identity;
        if (!isEngineer || found->role == Role::Engineer)
            return {messages::errorWord::evicted,
                    QStringLiteral("'%1' was evicted by %2; an operator can let it in again: qtplc admit '%1'")
                        .arg(each, found->by)};
    }
    return {};
}

}  // namespace qplc

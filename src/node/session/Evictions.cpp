// SPDX-License-Identifier: Apache-2.0
#include "Evictions.h"

#include "protocol/messages/Vocabulary.h"

namespace qplc {

bool Evictions::add(const QString &name, const QString &by, Role role)
{
    if (!contains(name) && m_evicted.size() >= Most)
        return false;
    m_evicted.insert(name, {by, role});
    return true;
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

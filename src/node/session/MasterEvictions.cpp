// SPDX-License-Identifier: Apache-2.0
#include "MasterEvictions.h"

#include "signals/MessageText.h"

namespace qplc {

namespace {

/// Who asks, for people. \param asker  null: the program of the master
QString shownAsker(const MasterConnection *asker)
{
    return asker ? QStringLiteral("'%1'").arg(asker->shownName()) : QStringLiteral("the master");
}

}  // namespace

MasterEvictions::MasterEvictions(Evictions &evictions, MasterServer &server, const NodeSessions &nodes,
                                 NeededNodes &needed, Journal &journal, const RealTimePhase &phase)
    : m_evictions(evictions)
    , m_server(server)
    , m_nodes(nodes)
    , m_needed(needed)
    , m_journal(journal)
    , m_phase(phase)
{
}

Refusal MasterEvictions::refusalOf(const QString &name, const MasterConnection *asker) const
{
    namespace words = messages::errorWord;
    QStringList others;
    for (const auto &connection : m_server.connections()) {
        const bool isEngineer = connection->peer.role == Role::Engineer && connection->peer.provenIdentity() == name;
        if (connection->isOf(name) && connection.get() == asker)
            return {words::denied, QStringLiteral("'%1' is you; somebody else has to evict you").arg(name)};
        if (isEngineer && asker && asker->peer.role != Role::Engineer)
            return {words::denied, QStringLiteral("Denied: only an Engineer may evict '%1'").arg(name)};
        others << connection->name << connection->peer.provenIdentity();
    }
    for (const auto &node : m_nodes.all()) {
        if (node->name() == name && node->object())
            return {words::nodeError,
                    QStringLiteral("node '%1' runs in the process of the master; stop the plant, or end the master")
                        .arg(name)};
    }
    if (!name.isEmpty() && (others.contains(name) || m_needed.contains(name)))
        return {};
    others.removeDuplicates();
    return {words::nodeError,
            QStringLiteral("nobody is connected as '%1'%2").arg(name, didYouMean(closeNames(name, others, 1)))};
}

bool MasterEvictions::evict(const QString &given, const MasterConnection *asker, Refusal *refusal)
{
    const QString name = MasterServer::nameOf(given);
    if (m_evictions.contains(name))
        return true;
    *refusal = refusalOf(name, asker);
    if (!refusal->error.isEmpty())
        return false;
    const QString by = shownAsker(asker);
    if (!m_evictions.add(name, by, asker ? asker->peer.role : Role::Engineer)) {
        *refusal = {messages::errorWord::tooMuch,
                    QStringLiteral("%1 names are evicted already; admit one of them, or start the master again")
                        .arg(Evictions::Most)};
        return false;
    }
    m_journal.tell(JournalEvent::Warning, JournalEvent::Security, name,
                   QStringLiteral("'%1' is evicted by %2%3").arg(name, by, m_phase.cycleText()));
    m_server.expel([&](const MasterConnection *connection) {
        return connection->isOf(name) ? m_evictions.refusalOf(name, connection->peer) : Refusal();
    });
    m_needed.tellFate(name, QStringLiteral("was evicted by %1: qtplc admit '%2'").arg(by, name));
    return true;
}

bool MasterEvictions::admit(const QString &given, const MasterConnection *asker, Refusal *refusal)
{
    const QString name = MasterServer::nameOf(given);
    if (!m_evictions.remove(name)) {
        *refusal
            = {messages::errorWord::nodeError,
               QStringLiteral("'%1' is not evicted%2").arg(name, didYouMean(closeNames(name, m_evictions.names(), 1)))};
        return false;
    }
    const QString by = shownAsker(asker);
    m_journal.tell(JournalEvent::Warning, JournalEvent::Security, name,
                   QStringLiteral("'%1' is admitted again by %2").arg(name, by));
    m_needed.tellFate(name, QStringLiteral("was evicted, and has not registered since it was admitted again"));
    return true;
}

}  // namespace qplc

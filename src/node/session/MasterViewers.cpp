// SPDX-License-Identifier: Apache-2.0
#include "MasterViewers.h"

namespace qplc {

MasterViewers::MasterViewers(const MasterServer &server, Journal &journal, const MasterWrites &settings,
                             const MasterLeases &leases, RealTimePhase &phase, const QPlcSignalTable &table)
    : m_server(server)
    , m_pushes(server, journal.events(), [&leases] { return messages::LeasesChanged{leases.entries()}; })
{
    connect(&server, &MasterServer::greeted, this,
            [&journal](MasterConnection *connection) { connection->eventsTold = journal.events().newest(); });
    connect(&journal, &Journal::appended, this, [this] { m_pushes.eventsHappened(); });
    connect(&leases, &MasterLeases::heldSignalsChanged, this, [&phase] {
        if (phase.isRunning())
            phase.renewRoster();
    });
    connect(&leases, &MasterLeases::changed, this, [&](JournalEvent::Severity severity, const QString &text) {
        journal.tell(severity, JournalEvent::Lease, NodeRegistry::masterName(), text);
        m_pushes.leasesChanged();
    });
    connect(&settings, &MasterWrites::valueSet, this,
            [&](const QObject *owner, QPlcSignalIndex signal, const QPlcValue &former, const QPlcValue &value) {
                const QPlcSignalDefinition &definition = table.at(signal);
                const MasterConnection *const by = connectionOf(owner);
                journal.valueSet(by ? by->shownName() : NodeRegistry::masterName(),
                                 by ? by->socket->peerName() : QString(), definition.name, definition.textOf(former),
                                 definition.textOf(value));
            });
    connect(&settings, &MasterWrites::valueCameBack, this, [&](QPlcSignalIndex signal, const QPlcValue &value) {
        journal.valueCameBack(table.at(signal).name, table.at(signal).textOf(value));
    });
}

/// Null: that of none, the program of the master.
const MasterConnection *MasterViewers::connectionOf(const QObject *socket) const
{
    for (const std::unique_ptr<MasterConnection> &connection : m_server.connections()) {
        if (connection->socket == socket)
            return connection.get();
    }
    return nullptr;
}

}  // namespace qplc

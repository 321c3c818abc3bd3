// SPDX-License-Identifier: Apache-2.0
// Leases and events: who has taken over what, what has happened, and who is told.
#include "QPlcMasterNodePrivate.h"
#include "node/session/MasterReplies.h"

using qplc::JournalEvent;

void QPlcMasterNodePrivate::prepareViewers()
{
    leases = std::make_unique<qplc::MasterLeases>(leaseBooks, *registry, *cycle, *settings);
    pushes = std::make_unique<qplc::ViewerPushes>(*server, journal.events(),
                                                  [this] { return qplc::messages::LeasesChanged{leases->entries()}; });
    QObject::connect(server.get(), &qplc::MasterServer::greeted, q,
                     [this](Connection *connection) { connection->eventsTold = journal.events().newest(); });
    QObject::connect(&journal, &qplc::Journal::appended, pushes.get(), [this] { pushes->eventsHappened(); });
    QObject::connect(leases.get(), &qplc::MasterLeases::heldSignalsChanged, q, [this] {
        if (isRunning())
            giveRoster();
    });
    QObject::connect(leases.get(), &qplc::MasterLeases::changed, q,
                     [this](JournalEvent::Severity severity, const QString &text) {
                         journal.tell(severity, JournalEvent::Lease, qplc::NodeRegistry::masterName(), text);
                         pushes->leasesChanged();
                         Q_EMIT q->leaseChanged();
                     });
    QObject::connect(
        settings.get(), &qplc::MasterSettings::valueSet, q,
        [this](const QObject *owner, QPlcSignalIndex signal, const QPlcValue &former, const QPlcValue &value) {
            const QPlcSignalDefinition &definition = table.at(signal);
            journal.valueSet(nameOf(owner), definition.name, definition.textOf(former), definition.textOf(value));
        });
    QObject::connect(settings.get(), &qplc::MasterSettings::valueCameBack, q,
                     [this](QPlcSignalIndex signal, const QPlcValue &value) {
                         journal.valueCameBack(table.at(signal).name, table.at(signal).textOf(value));
                     });
}

/// Who is at the other end of a connection; without one: the master.
QString QPlcMasterNodePrivate::nameOf(const QObject *socket) const
{
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->socket == socket)
            return connection->shownName();
    }
    return qplc::NodeRegistry::masterName();
}

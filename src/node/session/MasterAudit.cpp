// SPDX-License-Identifier: Apache-2.0
#include "MasterAudit.h"

#include "signals/MessageText.h"

namespace qplc {

namespace {

constexpr int mostNamesTold = 8;     // of signals, in a line
constexpr int longestNameTold = 48;  // [characters] of each: they fit into an event

/// " of setpoint, free"; empty for a command that is about no signals.
QString signalsText(const QPlcMessage &command)
{
    QStringList names = signalsWrittenBy(command);
    for (int i = 0; i < qMin(names.size(), mostNamesTold); ++i)
        names[i] = printable(names[i].left(longestNameTold));
    return names.isEmpty() ? QString() : QStringLiteral(" of ") + firstOf(names, mostNamesTold);
}

}  // namespace

MasterAudit::MasterAudit(const MasterServer &server, Journal &journal, const RealTimePhase &phase)
{
    connect(&server, &MasterServer::authenticated, this, [&](const MasterConnection *connection) {
        journal.accepted(connection->peer.identity, connection->socket->peerName(),
                         QStringLiteral("accepted identity '%1' with role %2 from %3%4")
                             .arg(printable(connection->peer.identity), roleName(connection->peer.role),
                                  connection->socket->peerName(), phase.cycleText()));
    });
    connect(&server, &MasterServer::denied, this, [&](const MasterConnection *connection, const QString &reason) {
        journal.denied(connection->peer.identity, connection->socket->peerName(),
                       QStringLiteral("%1 from %2").arg(reason, connection->socket->peerName()) + phase.cycleText());
    });
    connect(&server, &MasterServer::strangerRefused, this,
            [&](const QString &, const QString &address, const QString &reason) {
                journal.strangerRefused(address, reason + phase.cycleText());
            });
    connect(&server, &MasterServer::commanded, this,
            [&](const MasterConnection *connection, const QPlcMessage &message) {
                if (!connection->peer.isSecured)
                    return;
                journal.commanded(connection->peer.identity, connection->socket->peerName(), message.kindName(),
                                  QStringLiteral("%1 from %2%3")
                                      .arg(signalsText(message), connection->socket->peerName(), phase.cycleText()));
            });
    connect(&server, &MasterServer::rightsUnreadable, this, [&](const QString &error) {
        journal.tell(
            JournalEvent::Warning, JournalEvent::Security, NodeRegistry::masterName(),
            QStringLiteral("cannot read the key or rights file: %1. Connected clients stay; the master refuses new "
                           "ones. Repair the file.")
                .arg(error));
    });
    connect(&server, &MasterServer::refused, this,
            [&](const QString &name, const QString &address, const QString &reason) {
                journal.refused(name, address, reason);
            });
}

}  // namespace qplc

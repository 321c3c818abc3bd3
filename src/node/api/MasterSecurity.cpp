// SPDX-License-Identifier: Apache-2.0
// Who may come to QPlcMasterNodePrivate, and what is written down about it.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"

namespace {

constexpr int longestNameTold = 48;  // [characters] of a signal in a line; eight of them fit into an event

/// " of setpoint, free"; empty for a command that is about no signals.
QString signalsText(const QPlcMessage &command)
{
    QStringList names = qplc::signalsWrittenBy(command);
    for (QString &name : names)
        name = qplc::printable(name.left(longestNameTold));
    return names.isEmpty() ? QString() : QStringLiteral(" of ") + qplc::firstOf(names);
}

}  // namespace

bool QPlcMasterNodePrivate::checkSecurity()
{
    const QString wrong = security.errorString(QPlcSecurity::MasterSide);
    return wrong.isEmpty() || setError(QPlcMasterNode::ServerError, wrong);
}

/// Nobody who was not asked for opens the plant to a network.
void QPlcMasterNodePrivate::chooseAddress(QHostAddress *address)
{
    networkSecurity = security.modeName();
    if (address->isLoopback() || !security.isNone())
        return;
    if (insecureNetworkAllowed) {
        networkSecurity = qplc::messages::insecure;
        qCWarning(lcMaster).noquote() << "listening on" << address->toString()
                                      << "WITHOUT SECURITY: anybody on the network can read and command the plant";
        return;
    }
    qCWarning(lcMaster).noquote() << "listening on 127.0.0.1 only instead of" << address->toString()
                                  << "- anybody on the network could read and command the plant; use setSecurity() "
                                     "(--security psk), or open it by setInsecureNetworkAllowed(true)";
    *address = QHostAddress::LocalHost;
}

QString QPlcMasterNodePrivate::cycleText() const
{
    return isRunning() ? QStringLiteral(" in cycle %1").arg(q->cycle()) : QString();
}

void QPlcMasterNodePrivate::watchSecurity()
{
    QObject::connect(server.get(), &qplc::MasterServer::authenticated, q, [this](Connection *connection) {
        journal.tell(qplc::JournalEvent::Info, qplc::JournalEvent::Security, connection->peer.identity,
                     QStringLiteral("accepted identity '%1' with role %2 from %3%4")
                         .arg(qplc::printable(connection->peer.identity), qplc::roleName(connection->peer.role),
                              connection->socket->peerName(), cycleText()));
    });
    QObject::connect(
        server.get(), &qplc::MasterServer::denied, q, [this](Connection *connection, const QString &reason) {
            journal.denied(connection->peer.identity,
                           QStringLiteral("%1 from %2").arg(reason, connection->socket->peerName()) + cycleText());
        });
    QObject::connect(server.get(), &qplc::MasterServer::strangerRefused, q,
                     [this](const QString &, const QString &address, const QString &reason) {
                         journal.strangerRefused(address, reason + cycleText());
                     });
    QObject::connect(
        server.get(), &qplc::MasterServer::commanded, q, [this](Connection *connection, const QPlcMessage &message) {
            journal.commanded(
                connection->peer.identity, message.kindName(),
                QStringLiteral("%1 from %2%3").arg(signalsText(message), connection->socket->peerName(), cycleText()));
        });
    QObject::connect(server.get(), &qplc::MasterServer::refused, q,
                     [this](const QString &name, const QString &address, const QString &reason) {
                         journal.refused(name, address, reason);
                         Q_EMIT q->nodeRefused(name, reason);
                     });
}

// SPDX-License-Identifier: Apache-2.0
// Nodes that nobody waits for in QPlcMasterNodePrivate: listeners, and whoever joins while others run. They go through initialization and start at their own pace.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"

using Message = QPlcMessage;

std::vector<qplc::MasterConnection *> QPlcMasterNodePrivate::listeners() const
{
    std::vector<Connection *> found;
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->isAttached() && connection->slot->listener)
            found.push_back(connection.get());
    }
    return found;
}

/// Begins at the top, whatever the node has not answered yet.
void QPlcMasterNodePrivate::join(Connection *connection)
{
    connection->stage = Connection::GivingOutputs;
    connection->hasFailed = false;
    qplc::messages::SendYourInitialOutputStates request;
    if (isRunning() && !connection->slot->listener && defaults().keepsState)
        request.phase = cycle->cycleZero();
    connection->send(request);
}

void QPlcMasterNodePrivate::continueJoin(Connection *connection, Message::Kind answer, const QByteArray &outputs,
                                         bool goesOn)
{
    if (answer == Message::ReceiveMyInitialOutputStates && connection->stage == Connection::GivingOutputs) {
        if (!storeOutputs(connection, outputs))
            return;
        tellReturn(connection, goesOn);
        connection->stage = Connection::OutputsGiven;
    } else if (answer == Message::Initialized && connection->stage == Connection::Initializing) {
        connection->stage = Connection::Initialized;
    } else if (answer == Message::RealTimeReady && connection->stage == Connection::Starting) {
        connection->stage = Connection::Running;
    } else if (connection->slot->listener) {
        qCDebug(lcMaster).noquote() << "node" << connection->name << "gives the answer" << Message(answer).kindName()
                                    << "to a sequence that has ended";
        return;
    } else {
        connection->fail(QStringLiteral("WrongState"),
                         QStringLiteral("%1 was not asked for").arg(Message(answer).kindName()));
        return;
    }
    goOn(connection);
}

/// A node that was in this phase before is there again: as the same process, or as one that was started anew.
void QPlcMasterNodePrivate::tellReturn(const Connection *connection, bool goesOn)
{
    if (!isRunning() || connection->slot->listener || !m_gone.hasName(connection->name))
        return;
    if (goesOn)
        journal.tell(qplc::JournalEvent::Info, qplc::JournalEvent::Node, connection->name,
                     QStringLiteral("node %1 goes on where it was").arg(connection->name));
    else
        journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::Node, connection->name,
                     QStringLiteral("node %1 begins again at its initial state").arg(connection->name));
}

/// Tells the node what comes next, if the master has come so far.
void QPlcMasterNodePrivate::goOn(Connection *connection)
{
    if (connection->stage == Connection::OutputsGiven && m_step != Step::CollectOutputs) {
        connection->stage = Connection::Initializing;
        sendInitialInputs(connection);
    } else if (connection->stage == Connection::Initialized && (isRunning() || m_step == Step::Start)) {
        connection->stage = Connection::Starting;
        if (connection->slot->isInGroup()) {
            m_multicastParts.add(*connection->slot);  // a part of its own: the others know theirs
            m_multicastParts.finish();
        }
        connection->send(startOf(*connection->slot));
    } else if (connection->stage == Connection::Running && isRunning()) {
        giveRoster();
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "RemoteNode.h"

#include "MasterServer.h"

namespace qplc {

RemoteNode::RemoteNode(MasterServer &server, MasterConnection &connection)
    : NodeSession(connection.slot, Answers::Later)
    , m_server(server)
    , m_connection(&connection)
{
}

std::optional<NodeSession::Answer> RemoteNode::askOutputs(std::optional<quint64> phase)
{
    messages::SendYourInitialOutputStates request;
    if (phase)
        request.phase = *phase;
    if (m_connection)
        m_connection->send(request);
    return std::nullopt;
}

std::optional<NodeSession::Answer> RemoteNode::giveInputs(const QByteArray &values)
{
    if (m_connection)
        m_connection->send(messages::InitializeWithValues{values});
    return std::nullopt;
}

std::optional<NodeSession::Answer> RemoteNode::start(const messages::RealTimeStarted &start)
{
    if (m_connection)
        m_connection->send(start);
    return std::nullopt;
}

/// A client is told of an initialization that has ended whether it is a node or not:
/// MasterControl::announce().
void RemoteNode::cancel(const QString &reason, bool isStarting)
{
    if (isStarting)
        stop(reason);
    setStage(Idle);
}

/// No cycle runs any more.
messages::RealTimeStopped RemoteNode::stopMessage(const QString &reason) const
{
    messages::RealTimeStopped message;
    message.reason = reason;
    const bool isInPhase = stage() >= Starting;
    if (const auto last = isInPhase ? slot()->sentCycles.last() : std::nullopt) {
        message.lastCycle = last->cycle;
        message.before = last->before;
    }
    return message;
}

void RemoteNode::stop(const QString &reason)
{
    if (m_connection && stage() != Idle)
        m_connection->send(stopMessage(reason));
    setStage(Idle);
}

void RemoteNode::drop(const QString &reason)
{
    if (m_connection)
        m_server.drop(m_connection, reason);
}

QPlcSlaveNode::State RemoteNode::state() const
{
    if (hasFailed())
        return QPlcSlaveNode::Fault;
    if (stage() == Running)
        return slot()->isSafe ? QPlcSlaveNode::SafeStop : QPlcSlaveNode::RealTime;
    if (stage() >= Initialized)
        return QPlcSlaveNode::Ready;
    return stage() != Idle ? QPlcSlaveNode::Initializing : QPlcSlaveNode::Registered;
}

QString RemoteNode::transportName() const
{
    return m_connection ? m_connection->cyclicKind : QString();
}

bool RemoteNode::usesFallback() const
{
    return m_connection && !m_connection->fallbackReason.isEmpty();
}

QString RemoteNode::address() const
{
    return m_connection ? m_connection->socket->peerName() : QString();
}

QString RemoteNode::identity() const
{
    return m_connection ? m_connection->peer.provenIdentity() : QString();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSlaveSocket.h"
#include "node/security/Handshake.h"
#include "transport/ConnectionGate.h"
#include "transport/ControlListener.h"

#include <QtCore/QTimer>

#include <deque>
#include <map>

namespace qplc {

/// The entrance of a master: takes connections in, finds out who comes, and shows out who takes too
/// long or has to make room. What comes through is ready for messages.
class MasterDoor : public QObject
{
    Q_OBJECT
public:
    static constexpr int HandshakesInATurn = 2;  // of the event loop; each takes about 1 ms

    explicit MasterDoor(QObject *parent = nullptr);
    ~MasterDoor() override;

    void setSecurity(const QPlcSecurity &security) { m_security = security; }
    const QPlcSecurity &security() const { return m_security; }
    void setLimits(const ConnectionGate::Limits &limits) { m_gate.setLimits(limits); }
    ConnectionGate::Limits limits() const { return m_gate.limits(); }

    bool listen(const QHostAddress &address, quint16 port);
    void close();
    QHostAddress address() const { return m_listener.address(); }
    quint16 port() const { return m_listener.port(); }
    QString errorString() const { return m_listener.errorString(); }
    QAbstractSocket::SocketError error() const { return m_listener.error(); }

    /// Who has greeted is no stranger any more. \return false when there is no place for \a guest
    bool know(ConnectionGate::Ticket ticket, ConnectionGate::Guest guest) { return m_gate.know(ticket, guest); }
    /// The address has proven itself: a node of it is there, or somebody with a key.
    void trust(ConnectionGate::Ticket ticket) { m_gate.trust(ticket); }
    void leave(ConnectionGate::Ticket ticket) { m_gate.leave(ticket); }
    /// Connections that were closed because there was no room, at the time, for them or for their
    /// identity.
    quint64 turnedAway() const { return m_turnedAway + m_listener.withoutDescriptor(); }
    /// Connections whose handshake has failed, or took too long.
    quint64 failedHandshakes() const { return m_failedHandshakes; }

Q_SIGNALS:
    /// Somebody is in. \param socket  owned by the receiver
    void entered(QPlcSlaveSocket *socket, const qplc::Peer &peer, qplc::ConnectionGate::Ticket ticket);
    /// \param identity  as claimed; empty: none
    void refused(const QString &identity, const QString &address, const QString &reason);
    /// Somebody who is in has not greeted, and has to go.
    void tooSlow(qplc::ConnectionGate::Ticket ticket, const QString &reason);

private:
    void acceptAll();
    bool accept(int descriptor);
    void handshakeWanted(ConnectionGate::Ticket ticket);
    void beginHandshakes();
    void handshakeEnded(ConnectionGate::Ticket ticket);
    void turnAway(ConnectionGate::Ticket ticket, Handshake *handshake);
    void forget(ConnectionGate::Ticket ticket);
    void sweep();
    void showOut(ConnectionGate::Ticket ticket, const QString &reason);

    ControlListener m_listener;
    ConnectionGate m_gate;
    QPlcSecurity m_security;
    std::map<ConnectionGate::Ticket, Handshake *> m_handshakes;
    std::deque<ConnectionGate::Ticket> m_beginning;  // of m_handshakes, or gone meanwhile: wait for their turn
    QTimer m_sweeper;
    QTimer m_beginner;  // rings while they wait
    quint64 m_turnedAway = 0;
    quint64 m_failedHandshakes = 0;
};

}  // namespace qplc

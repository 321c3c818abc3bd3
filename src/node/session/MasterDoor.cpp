// SPDX-License-Identifier: Apache-2.0
#include "MasterDoor.h"

#include "realtime/TimeSource.h"
#include "transport/ControlNetwork.h"

namespace qplc {

namespace {

constexpr int sweepInterval = 100;  // [ms]

}  // namespace

MasterDoor::MasterDoor(QObject *parent)
    : QObject(parent)
{
    m_sweeper.setInterval(sweepInterval);
    connect(&m_sweeper, &QTimer::timeout, this, &MasterDoor::sweep);
    connect(&m_listener, &ControlListener::arrived, this, &MasterDoor::acceptAll);
}

MasterDoor::~MasterDoor()
{
    close();
}

bool MasterDoor::listen(const QHostAddress &address, quint16 port)
{
    return m_listener.listen(address, port);
}

void MasterDoor::close()
{
    m_listener.close();
    while (!m_handshakes.empty())
        forget(m_handshakes.begin()->first);
    m_sweeper.stop();
}

void MasterDoor::know(ConnectionGate::Ticket ticket)
{
    m_gate.know(ticket);
    goOn();
}

void MasterDoor::leave(ConnectionGate::Ticket ticket)
{
    m_gate.leave(ticket);
    goOn();
}

/// There may be room again.
void MasterDoor::goOn()
{
    m_listener.setAttentive(m_gate.hasRoom());
}

void MasterDoor::acceptAll()
{
    while (m_gate.hasRoom()) {
        const int descriptor = m_listener.take();
        if (descriptor < 0)
            break;
        accept(descriptor);
    }
    if (!m_gate.hasRoom())
        m_listener.setAttentive(false);
    if (m_gate.strangers() > 0 || !m_listener.isAttentive())
        m_sweeper.start();
}

void MasterDoor::accept(int descriptor)
{
    const QHostAddress address = ControlNetwork::current().peerOf(descriptor);
    ConnectionGate::Refusal refusal = ConnectionGate::Admitted;
    const std::optional<ConnectionGate::Ticket> ticket = m_gate.admit(address, monotonicNow(), &refusal);
    if (!ticket) {
        ControlNetwork::current().close(descriptor);
        ++m_turnedAway;
        Q_EMIT refused(QString(), address.toString(), QString::fromLatin1(ConnectionGate::textOf(refusal)));
        return;
    }
    auto *handshake = new Handshake(descriptor, m_security, this);
    m_handshakes[*ticket] = handshake;
    connect(handshake, &Handshake::succeeded, this, [this, number = *ticket] { handshakeEnded(number); });
    connect(handshake, &Handshake::failed, this, [this, number = *ticket, handshake](const QString &reason) {
        const QString identity = handshake->claimedIdentity();
        const QString from = handshake->address();
        forget(number);
        if (reason.isEmpty())
            return;
        ++m_failedHandshakes;
        Q_EMIT refused(identity, from, reason);
    });
}

void MasterDoor::handshakeEnded(ConnectionGate::Ticket ticket)
{
    Handshake *handshake = m_handshakes[ticket];
    if (handshake->peer().isSecured && !m_gate.prove(ticket, handshake->peer().identity)) {
        turnAway(ticket, handshake);
        return;
    }
    m_handshakes.erase(ticket);
    m_gate.renew(ticket, monotonicNow());
    auto *socket = new QPlcSlaveSocket(handshake->takeSocket());
    const Peer peer = handshake->peer();
    handshake->deleteLater();
    Q_EMIT entered(socket, peer, ticket);
}

void MasterDoor::turnAway(ConnectionGate::Ticket ticket, Handshake *handshake)
{
    const QString reason = QString::fromLatin1(ConnectionGate::textOf(ConnectionGate::TooManyOfIdentity));
    const QString identity = handshake->claimedIdentity();
    const QString from = handshake->address();
    handshake->turnAway(reason);
    forget(ticket);
    ++m_turnedAway;
    Q_EMIT refused(identity, from, QStringLiteral("identity '%1': %2").arg(identity, reason));
}

void MasterDoor::forget(ConnectionGate::Ticket ticket)
{
    const auto found = m_handshakes.find(ticket);
    if (found == m_handshakes.end())
        return;
    found->second->disconnect(this);
    found->second->deleteLater();
    m_handshakes.erase(found);
    leave(ticket);
}

void MasterDoor::sweep()
{
    const auto showOut = [this](ConnectionGate::Ticket ticket) {
        const auto found = m_handshakes.find(ticket);
        if (!m_gate.overdue(monotonicNow()).contains(ticket))
            return;
        if (found == m_handshakes.end()) {
            Q_EMIT tooSlow(ticket);
            return;
        }
        const QString from = found->second->address();
        const QString reason = found->second->stage();
        ++m_failedHandshakes;
        forget(ticket);
        Q_EMIT refused(QString(), from, reason);
    };
    // Not at once: when this thread was busy with something else, what they have said waits to be
    // read.
    for (ConnectionGate::Ticket ticket : m_gate.overdue(monotonicNow()))
        QTimer::singleShot(sweepInterval / 2, this, [showOut, ticket] { showOut(ticket); });
    goOn();
    acceptAll();
    if (m_gate.strangers() == 0 && m_listener.isAttentive())
        m_sweeper.stop();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "MasterDoor.h"

#include "realtime/TimeSource.h"
#include "transport/ControlNetwork.h"

namespace qplc {

namespace {

constexpr int sweepInterval = 100;                    // [ms]
constexpr int admittedAtOnce = 8;                     // connections in a turn of the event loop
constexpr std::int64_t longestAccepting = 2'000'000;  // in such a turn [ns]

}  // namespace

MasterDoor::MasterDoor(QObject *parent)
    : QObject(parent)
{
    m_sweeper.setInterval(sweepInterval);
    connect(&m_sweeper, &QTimer::timeout, this, &MasterDoor::sweep);
    connect(&m_listener, &ControlListener::arrived, this, &MasterDoor::acceptAll);
    m_beginner.setInterval(0);  // a single shot that starts itself again may ring twice in a turn
    connect(&m_beginner, &QTimer::timeout, this, &MasterDoor::beginHandshakes);
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
    m_beginning.clear();
    m_beginner.stop();
    m_sweeper.stop();
}

/// A few in each turn of the event loop: those who came before say something in between. Who is
/// closed at once costs little, and must not fill the queue of the system. While many handshakes
/// wait for their turn, newcomers wait there: else they would crowd those out.
void MasterDoor::acceptAll()
{
    if (m_beginning.size() >= std::size_t(admittedAtOnce))
        return;
    const std::int64_t end = monotonicNow() + longestAccepting;
    for (int admitted = 0; admitted < admittedAtOnce && monotonicNow() < end;) {
        const int descriptor = m_listener.take();
        if (descriptor < 0)
            break;
        admitted += accept(descriptor) ? 1 : 0;
    }
    if ((m_gate.strangers() > 0 || !m_listener.isAttentive()) && !m_sweeper.isActive())
        m_sweeper.start();
}

bool MasterDoor::accept(int descriptor)
{
    const QHostAddress address = ControlNetwork::current().peerOf(descriptor);
    const ConnectionGate::Admission admission = m_gate.admit(address, monotonicNow());
    if (admission.ticket == 0) {
        ControlNetwork::current().close(descriptor);
        ++m_turnedAway;
        Q_EMIT refused(QString(), address.toString(), QString::fromLatin1(ConnectionGate::textOf(admission.refusal)));
        return false;
    }
    if (admission.crowdedOut != 0)
        showOut(admission.crowdedOut, QStringLiteral("too many connections have not sent Hello"));
    auto *handshake = new Handshake(descriptor, m_security, this);
    m_handshakes[admission.ticket] = handshake;
    connect(handshake, &Handshake::tlsWanted, this, [this, number = admission.ticket] { handshakeWanted(number); });
    connect(handshake, &Handshake::succeeded, this, [this, number = admission.ticket] { handshakeEnded(number); });
    connect(handshake, &Handshake::failed, this, [this, number = admission.ticket, handshake](const QString &reason) {
        const QString identity = handshake->claimedIdentity();
        const QString from = handshake->address();
        forget(number);
        if (reason.isEmpty())
            return;
        ++m_failedHandshakes;
        Q_EMIT refused(identity, from, reason);
    });
    return true;
}

/// A connection whose address has used up its handshakes is closed before one costs anything.
void MasterDoor::handshakeWanted(ConnectionGate::Ticket ticket)
{
    if (m_gate.hear(ticket, monotonicNow())) {
        m_beginning.push_back(ticket);
        if (!m_beginner.isActive())
            m_beginner.start();
        return;
    }
    const QString from = m_handshakes[ticket]->address();
    forget(ticket);
    ++m_turnedAway;
    Q_EMIT refused(QString(), from, QString::fromLatin1(ConnectionGate::textOf(ConnectionGate::TooManyHandshakes)));
}

/// A few in each turn of the event loop, of all addresses together.
void MasterDoor::beginHandshakes()
{
    for (int begun = 0; begun < HandshakesInATurn && !m_beginning.empty();) {
        const auto found = m_handshakes.find(m_beginning.front());
        m_beginning.pop_front();
        if (found == m_handshakes.end())
            continue;
        found->second->beginTls();
        ++begun;
    }
    if (m_beginning.empty())
        m_beginner.stop();
}

void MasterDoor::handshakeEnded(ConnectionGate::Ticket ticket)
{
    Handshake *handshake = m_handshakes[ticket];
    if (handshake->peer().isSecured && !m_gate.prove(ticket, handshake->peer().identity)) {
        turnAway(ticket, handshake);
        return;
    }
    if (handshake->peer().isSecured)
        m_gate.trust(ticket);
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

/// \param reason  empty: what takes it so long
void MasterDoor::showOut(ConnectionGate::Ticket ticket, const QString &reason)
{
    const auto found = m_handshakes.find(ticket);
    if (found == m_handshakes.end()) {
        Q_EMIT tooSlow(ticket, reason.isEmpty() ? QStringLiteral("it has not greeted in time") : reason);
        return;
    }
    const QString from = found->second->address();
    const QString stage = found->second->stage();
    ++m_failedHandshakes;
    forget(ticket);
    Q_EMIT refused(QString(), from, reason.isEmpty() ? stage : reason);
}

void MasterDoor::sweep()
{
    const auto lookAgain = [this](ConnectionGate::Ticket ticket) {
        if (m_gate.overdue(monotonicNow()).contains(ticket))
            showOut(ticket, QString());
    };
    // Not at once: when this thread was busy with something else, what they have said waits to be
    // read.
    for (ConnectionGate::Ticket ticket : m_gate.overdue(monotonicNow()))
        QTimer::singleShot(sweepInterval / 2, this, [lookAgain, ticket] { lookAgain(ticket); });
    m_listener.setAttentive(true);
    if (m_gate.strangers() == 0)
        m_sweeper.stop();
}

}  // namespace qplc

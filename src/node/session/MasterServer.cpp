// SPDX-License-Identifier: Apache-2.0
#include "MasterServer.h"

#include "PacedReading.h"
#include "node/Logging.h"
#include "protocol/ControlFrame.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/TimeSource.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QScopedValueRollback>

#include <algorithm>
#include <utility>

namespace qplc {

using Message = QPlcMessage;

namespace {

constexpr quint32 LongestGreeting = 64 * 1024;  // [byte]
constexpr int LongestReason = 4000;             // [characters] of a refusal, which may quote what was sent
constexpr int LongMessageLook = 1000;           // [ms] between two looks for messages that do not end

/// What a client may have to send: Register with all signals both ways, all values as texts, or the
/// outputs of a node that writes all signals.
quint32 longestMessageFor(const QPlcSignalTable &table)
{
    constexpr quint64 described = 256;  // [byte] of an input and an output without their texts
    quint64 bytes = UsualControlFrame;
    for (const QPlcSignalDefinition &signal : table)  // of each character of a unit, JSON may make six
        bytes += described + quint64(2 * signal.name.size() + 12 * signal.unit.size() + 8 * signal.type.size());
    return quint32(std::min<quint64>(bytes, MaximumControlFrame));
}

}  // namespace

MasterServer::MasterServer(NodeRegistry &registry, const ProcessImage &image, CyclicHub &hub, quint64 session,
                           std::function<messages::MasterHello()> hello, Objection objection,
                           const Evictions &evictions, QObject *parent)
    : QObject(parent)
    , m_registry(registry)
    , m_image(image)
    , m_hub(hub)
    , m_session(session)
    , m_hello(std::move(hello))
    , m_objection(std::move(objection))
    , m_greeting(image.table())
    , m_longestMessage(longestMessageFor(image.table()))
    , m_evictions(evictions)
    , m_door(this)
    , m_turns([this](FairTurns::Client client) { return serve(static_cast<MasterConnection *>(client)); })
{
    m_nextTurn.setSingleShot(true);
    connect(&m_nextTurn, &QTimer::timeout, this, &MasterServer::takeTurn);
    connect(&m_longMessageTimer, &QTimer::timeout, this, &MasterServer::dropOverdue);
    connect(&m_door, &MasterDoor::entered, this, &MasterServer::enter);
    connect(&m_door, &MasterDoor::refused, this, &MasterServer::strangerRefused);
    connect(&m_door, &MasterDoor::tooSlow, this, &MasterServer::dropSlow);
    connect(&m_rights, &RightsWatch::changed, this, &MasterServer::expelRevoked);
    connect(&m_rights, &RightsWatch::unreadable, this, &MasterServer::rightsUnreadable);
}

MasterServer::~MasterServer()
{
    close();
}

void MasterServer::setSecurity(const QPlcSecurity &security)
{
    m_isSecured = !security.isNone();
    m_door.setSecurity(security);
}

void MasterServer::setMaximumConnections(int connections)
{
    ConnectionGate::Limits limits = m_door.limits();
    limits.connections = connections;
    m_door.setLimits(limits);
}

void MasterServer::count(QPlcMasterStatistics *statistics) const
{
    statistics->refusedConnections = m_door.turnedAway();
    statistics->failedHandshakes = m_door.failedHandshakes();
    statistics->deniedMessages = m_deniedMessages;
}

// ---- ports ----

static QString remedyForListening(QAbstractSocket::SocketError error)
{
    switch (error) {
    case QAbstractSocket::SocketAddressNotAvailableError:
        return QStringLiteral("this computer has no such address, 'ip address' shows those that it has");
    case QAbstractSocket::SocketAccessError:
        return QStringLiteral("ports below 1024 are for root, choose a higher one");
    default:
        return QStringLiteral("choose another port, or end the program that uses it");
    }
}

bool MasterServer::openPorts(const QHostAddress &address, quint16 port)
{
    if (!m_door.listen(address, port)) {
        m_errorString = QStringLiteral("cannot listen on %1:%2: %3; %4")
                            .arg(address.toString())
                            .arg(port)
                            .arg(m_door.errorString(), remedyForListening(m_door.error()));
        return false;
    }
    if (m_hub.open(SocketAddress(m_door.address(), m_door.port()), &m_errorString))
        return true;
    m_door.close();
    return false;
}

bool MasterServer::listen(const QHostAddress &address, quint16 port, const QString &name, const QHostAddress &group)
{
    close();
    m_address = address;
    // A free TCP port may be taken on UDP: with port 0 another one will do.
    for (int attempts = port == 0 ? 16 : 1; attempts > 0; --attempts) {
        if (!openPorts(address, port))
            continue;
        if ((name.isEmpty() || m_name.hold(name, this->port(), &m_errorString))
            && openTransports({address, group, m_isSecured, m_session})) {
            m_rights.begin(m_door.security());
            return true;
        }
        close();
        return false;
    }
    return false;
}

bool MasterServer::openTransports(const MasterPlace &place)
{
    const auto opens = [&](const auto &kind) { return !kind->isAtHand() || kind->open(m_hub, place, &m_errorString); };
    const auto &kinds = TransportRegistry::instance().kinds();
    return std::all_of(kinds.begin(), kinds.end(), opens);
}

void MasterServer::close()
{
    m_name.release();
    m_rights.end();
    m_door.close();
    for (const std::unique_ptr<MasterConnection> &connection : m_connections)
        connection->send(messages::MasterEnds());
    while (!m_connections.empty())
        drop(m_connections.back().get(), QStringLiteral("the master closes its server"));
    m_hub.close();
}

quint16 MasterServer::port() const
{
    return m_door.port();
}

// ---- connections ----

void MasterServer::enter(QPlcSlaveSocket *socket, const Peer &peer, ConnectionGate::Ticket ticket)
{
    m_connections.push_back(std::make_unique<MasterConnection>());
    MasterConnection *connection = m_connections.back().get();
    connection->socket = socket;
    connection->peer = peer;
    connection->ticket = ticket;
    socket->setParent(this);
    socket->setMessageLimit(LongestGreeting);
    connect(socket, &QPlcAbstractSocket::messageReceived, this,
            [this, connection](const Message &message) { receive(connection, message); });
    PacedReading::begin(*socket, [this, connection] { arrived(connection); });
    PacedReading::setLong(*socket, &messages::mayBeLong,
                          [this, connection](quint32 length) { return admitsLong(connection, length); });
    connect(socket, &QPlcAbstractSocket::errorOccurred, this, [this, connection](QPlcAbstractSocket::Error error) {
        if (error == QPlcAbstractSocket::ProtocolError)
            receiveGarbage(connection);
    });
    // Not at once: a message that cannot be sent ends the connection, and who sends to many of them
    // walks over m_connections.
    const QPointer<QPlcSlaveSocket> guarded(socket);
    connect(
        socket, &QPlcAbstractSocket::disconnected, this, [this, guarded] { dropClosed(guarded); },
        Qt::QueuedConnection);
    if (!peer.isSecured)
        return;
    Q_EMIT authenticated(connection);
    m_rights.check();
    if (connectionOf(guarded) != connection)
        return;
    const Refusal refusal = revocation(connection);  // its handshake may have read older files
    if (!refusal.error.isEmpty())
        expelOne(guarded, refusal);
}

void MasterServer::dropSlow(ConnectionGate::Ticket ticket, const QString &reason)
{
    const auto isIt
        = [ticket](const std::unique_ptr<MasterConnection> &connection) { return connection->ticket == ticket; };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isIt);
    if (found != m_connections.end())
        reject(found->get(), messages::errorWord::timedOut, reason);
}

MasterConnection *MasterServer::connectionOf(const QPlcSlaveSocket *socket) const
{
    const auto isIt
        = [socket](const std::unique_ptr<MasterConnection> &connection) { return connection->socket == socket; };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isIt);
    return found == m_connections.end() ? nullptr : found->get();  // dropped meanwhile
}

void MasterServer::dropClosed(const QPlcSlaveSocket *socket)
{
    MasterConnection *connection = connectionOf(socket);
    if (!connection)
        return;
    const QString error = socket->errorString();
    drop(connection, error.isEmpty() ? QStringLiteral("it closed the connection") : error);
}

MasterConnection *MasterServer::connectionOf(const NodeSlot *slot) const
{
    for (const std::unique_ptr<MasterConnection> &connection : m_connections) {
        if (connection->slot.get() == slot)
            return connection.get();
    }
    return nullptr;
}

void MasterServer::drop(MasterConnection *connection, const QString &reason)
{
    connection->socket->disconnect(this);
    connection->socket->close();
    if (connection->slot) {
        connection->slot->lost = true;
        m_registry.remove(connection->slot);
        Q_EMIT lost(connection, reason);
    }
    forget(connection);
}

void MasterServer::forget(MasterConnection *connection)
{
    m_door.leave(connection->ticket);
    m_turns.remove(connection);
    longMessageEnded(connection);
    connection->nextStep = nullptr;
    freeLongRead(connection);
    PacedReading::begin(*connection->socket, [] {});
    connection->socket->disconnect(this);
    connection->socket->deleteLater();
    const auto isIt
        = [connection](const std::unique_ptr<MasterConnection> &other) { return other.get() == connection; };
    m_connections.erase(std::remove_if(m_connections.begin(), m_connections.end(), isIt), m_connections.end());
}

void MasterServer::reject(MasterConnection *connection, const QString &error, const QString &reason)
{
    const QString text = printable(reason.left(LongestReason));
    const QPointer<QPlcSlaveSocket> socket(connection->socket);
    connection->send(messages::Rejected{error, text});
    Q_EMIT refused(connection->shownName(), socket->peerName(), text);
    if (connectionOf(socket) == connection)  // else who heard of it has ended it
        drop(connection, text);
}

// ---- out ----

/// Who hears of one of them may end others.
void MasterServer::expel(const std::function<Refusal(MasterConnection *)> &refusalOf)
{
    std::vector<std::pair<QPointer<QPlcSlaveSocket>, Refusal>> out;
    for (const std::unique_ptr<MasterConnection> &connection : m_connections) {
        const bool isEnding = connection->slot && connection->slot->lost;
        const Refusal refusal = isEnding ? Refusal() : refusalOf(connection.get());
        if (!refusal.error.isEmpty())
            out.emplace_back(connection->socket, refusal);
    }
    for (const auto &[socket, refusal] : out)
        expelOne(socket, refusal);
}

void MasterServer::expelOne(const QPointer<QPlcSlaveSocket> &socket, const Refusal &refusal)
{
    MasterConnection *connection = connectionOf(socket);
    if (connection && connection == m_receiving)  // it is in use until its message is carried out
        QMetaObject::invokeMethod(
            this, [this, socket, refusal] { expelOne(socket, refusal); }, Qt::QueuedConnection);
    else if (connection && !(connection->slot && connection->slot->lost))
        reject(connection, refusal.error, refusal.text);
}

/// Why somebody who is in would not be let in by the present files; no error: it may stay. A node
/// may stay as long as it may still be what it has registered as; others connect again.
Refusal MasterServer::revocation(MasterConnection *connection) const
{
    const Peer &former = connection->peer;
    if (!former.isSecured)
        return {};
    const auto denied = [&](const char *text) {
        return Refusal{messages::errorWord::denied, QString::fromLatin1(text).arg(former.identity)};
    };
    const auto found = m_rights.peers().constFind(former.identity);
    if (found == m_rights.peers().constEnd())
        return denied("identity '%1' is revoked: the files of the master do not have it any more");
    if (found->keyMark != former.keyMark)
        return denied("the key of identity '%1' is revoked: the master has another one now; copy it from there");
    const bool isSame = found->hasRightsOf(former);
    if (!isSame && !(connection->slot && refusalOf(*found, registrationOf(*connection->slot)).isEmpty()))
        return denied("the rights of identity '%1' were changed at the master; connect again");
    connection->peer = *found;
    return {};
}

/// What a node has registered, as far as it needs rights.
messages::Register MasterServer::registrationOf(const NodeSlot &slot) const
{
    messages::Register registration;
    registration.name = slot.name;
    registration.listener = slot.listener;
    for (const PayloadLayout::Field &field : slot.outputLayout.fields()) {
        registration.outputs.emplace_back();
        registration.outputs.back().name = m_image.table().at(field.signal).name;
    }
    return registration;
}

void MasterServer::expelRevoked()
{
    expel([this](MasterConnection *connection) { return revocation(connection); });
}

/// A request is refused, and the connection stays; not so before the greeting, and of a node that
/// is none.
void MasterServer::deny(MasterConnection *connection, const QString &reason, bool isRegistration)
{
    ++m_deniedMessages;
    Q_EMIT denied(connection, reason);
    if (connection->stage == MasterConnection::Silent || isRegistration)
        reject(connection, messages::errorWord::denied, reason);
    else
        connection->fail(messages::errorWord::denied, reason);
}

/// Whether somebody asks faster than is good for the others; then the connection has ended. Who
/// does not read the answers is not listened to by the socket.
bool MasterServer::isTooMuch(MasterConnection *connection, const Message &message)
{
    if (connection->owes(message.kind()) || connection->messages.take(monotonicNow()))
        return false;
    ++m_deniedMessages;
    reject(connection, messages::errorWord::tooMuch,
           QStringLiteral("'%1' sends too many messages; send at most 1000 in a second").arg(connection->shownName()));
    return true;
}

// ---- turns ----

void MasterServer::arrived(MasterConnection *connection)
{
    m_turns.add(connection);
    if (!m_nextTurn.isActive())
        m_nextTurn.start(0);
}

/// Between two turns the event loop reads what has arrived, and its timers ring. If a turn was too
/// short for all, urgent messages of the next one come first.
void MasterServer::takeTurn()
{
    if (m_isBusy) {
        for (FairTurns::Client client : m_turns.waiting())
            lookAhead(static_cast<MasterConnection *>(client));
    }
    m_turns.serve();
    m_isBusy = !m_turns.isEmpty();
    if (m_isBusy)
        m_nextTurn.start(0);
}

/// A small piece of work for a connection, which may be gone afterwards. \return whether there is
/// more
bool MasterServer::serve(MasterConnection *connection)
{
    std::shared_ptr<LongRead> kept = connection->longRead;  // whoever ends the connection does not free it here
    const bool wantsMore = serveStep(connection);
    if (kept)
        m_reader.begin([kept = std::move(kept)] {});
    return wantsMore;
}

bool MasterServer::serveStep(MasterConnection *connection)
{
    if (connection->nextStep) {
        const QScopedValueRollback<MasterConnection *> receiving(m_receiving, connection);
        std::exchange(connection->nextStep, nullptr)();
        return true;
    }
    if (connection->listAnswer) {
        if (connection->listAnswer->makePortion())
            sendListAnswer(connection);
        return true;
    }
    if (connection->longRead && connection->longRead->stage == LongRead::Given)
        freeLongRead(connection);
    if (connection->longRead && connection->longRead->stage == LongRead::Ended) {
        giveLongRead(connection);
        return true;
    }
    if (!connection->longRead && (beginLongRead(connection) || PacedReading::next(*connection->socket)))
        return true;
    if (isThere(connection))  // it may take in no answers, or a long message of it is being read
        lookAhead(connection);
    return false;
}

void MasterServer::sendListAnswer(MasterConnection *connection)
{
    const std::unique_ptr<messages::ListAnswer> answer = std::move(connection->listAnswer);
    if (answer->isTooLong() || !PacedReading::send(*connection->socket, answer->kind(), answer->json()))
        connection->fail(messages::errorWord::tooLong, answer->tooLong());
}

/// Carries out urgent messages of a connection before what it has asked in front of them. They are
/// answered in their place.
void MasterServer::lookAhead(MasterConnection *connection)
{
    Message message;
    while (isThere(connection) && connection->stage != MasterConnection::Silent
           && PacedReading::takeAhead(*connection->socket, &messages::isUrgent, &message)) {
        connection->isAhead = true;
        receive(connection, message);
        if (isThere(connection))
            connection->isAhead = false;
    }
}

bool MasterServer::isThere(const MasterConnection *connection) const
{
    return std::any_of(m_connections.begin(), m_connections.end(),
                       [connection](const std::unique_ptr<MasterConnection> &one) { return one.get() == connection; });
}

/// Whether a connection may go on sending a message that takes much memory. Others wait for it.
bool MasterServer::admitsLong(MasterConnection *connection, quint32 length)
{
    const QString identity = connection->peer.provenIdentity();
    const QString origin = identity.isEmpty() ? connection->socket->peerAddress().toString() : identity;
    if (!m_longMessages.admit(connection, origin, length, monotonicNow()))
        return false;
    if (!m_longMessageTimer.isActive())
        m_longMessageTimer.start(LongMessageLook);
    return true;
}

/// Whoever waits for \a connection tries again.
void MasterServer::longMessageEnded(MasterConnection *connection)
{
    for (LongMessages::Client client : m_longMessages.leave(connection))
        arrived(static_cast<MasterConnection *>(client));
    if (m_longMessages.isEmpty())
        m_longMessageTimer.stop();
}

void MasterServer::dropOverdue()
{
    for (LongMessages::Client client : m_longMessages.overdue(monotonicNow())) {
        auto *connection = static_cast<MasterConnection *>(client);
        if (isThere(connection) && !connection->longRead)  // else all of it has arrived
            reject(connection, messages::errorWord::timedOut,
                   QStringLiteral("a message of '%1' does not end; send it at more than 1 MB in a second")
                       .arg(connection->shownName()));
    }
}

// ---- long messages ----

/// Lets another thread read the next message if it is long. Who may not send such a message gets
/// its answer before anybody reads it. \return false: the next message is not there, or not long
bool MasterServer::beginLongRead(MasterConnection *connection)
{
    auto read = std::make_shared<LongRead>();
    if (!PacedReading::takeLong(*connection->socket, &read->frame))
        return false;
    connection->longRead = read;
    const QPlcMessage::Kind kind = read->frame.kind();
    if (!refusalOf(connection->peer, kind).isEmpty()) {
        read->stage = LongRead::Ended;
        read->message = QPlcMessage(kind);
        return true;
    }
    const QPointer<QPlcSlaveSocket> socket(connection->socket);
    m_reader.begin([read = std::move(read)] { read->read(); }, [this, socket] { longReadEnded(socket); });
    if (!m_readerNotifier && m_reader.descriptor() >= 0) {
        m_readerNotifier = std::make_unique<QSocketNotifier>(m_reader.descriptor(), QSocketNotifier::Read);
        connect(m_readerNotifier.get(), &QSocketNotifier::activated, this, [this] { m_reader.collect(); });
    }
    return true;
}

/// Of somebody who may be gone: then nobody wants it any more.
void MasterServer::longReadEnded(const QPlcSlaveSocket *socket)
{
    MasterConnection *connection = socket ? connectionOf(socket) : nullptr;
    if (!connection)
        return;
    connection->longRead->stage = LongRead::Ended;
    arrived(connection);
}

/// What was read is carried out, in steps.
void MasterServer::giveLongRead(MasterConnection *connection)
{
    const std::shared_ptr<LongRead> read = connection->longRead;
    read->stage = LongRead::Given;
    if (read->error == ControlFrameReader::NoError)
        PacedReading::giveLong(*connection->socket, read->message);
    else
        PacedReading::refuseLong(*connection->socket, read->error, read->errorText);
}

/// To give back the memory of a million fields also takes long.
void MasterServer::freeLongRead(MasterConnection *connection)
{
    if (connection->longRead)
        m_reader.begin([read = std::move(connection->longRead)] {});
}

/// Whether a message was dealt with because of one that has overtaken others: its own answer is
/// kept, or it is a command that stood in front of a stop.
bool MasterServer::isSettled(MasterConnection *connection, const Message &message)
{
    if (connection->isAhead)
        return false;
    if (PacedReading::wasTakenAhead(*connection->socket)) {
        if (!connection->keptAnswers.empty()) {
            connection->socket->sendMessage(connection->keptAnswers.front());
            connection->keptAnswers.pop_front();
        }
        return true;
    }
    if (!PacedReading::isOvertaken(*connection->socket) || !messages::isCommand(message.kind()))
        return false;
    connection->fail(messages::errorWord::wrongState,
                     QStringLiteral("%1 was overtaken by a stop, or by the release of a lease, that was sent after it")
                         .arg(message.kindName()));
    return true;
}

/// The one place where control messages come in.
void MasterServer::receive(MasterConnection *connection, const Message &message)
{
    if (!connection->isAhead)
        longMessageEnded(connection);
    if (isSettled(connection, message) || isTooMuch(connection, message))
        return;
    const QScopedValueRollback<MasterConnection *> receiving(m_receiving, connection);
    if (message.kind() == Message::Register)  // of 65 534 signals, each of its steps is long
        connection->nextStep = [this, connection, message] { carryOut(connection, message); };
    else
        carryOut(connection, message);
}

void MasterServer::carryOut(MasterConnection *connection, const Message &message)
{
    const QString refusal = refusalOf(connection->peer, message);
    if (!refusal.isEmpty()) {
        deny(connection, refusal, message.kind() == Message::Register);
        return;
    }
    if (messages::isCommand(message.kind()))
        Q_EMIT commanded(connection, message);
    const bool begins = message.kind() == Message::Hello || message.kind() == Message::AttachCyclicChannel;
    if (connection->stage == MasterConnection::Silent && !begins) {
        reject(connection, messages::errorWord::wrongState,
               QStringLiteral("%1 before Hello; greet first").arg(message.kindName()));
        return;
    }
    if (connection->longRead && message.kind() == Message::Register) {
        if (connection->longRead->registration)
            open(connection, connection->longRead->registration);
        else
            reject(connection, messages::errorWord::malformedMessage, connection->longRead->fault);
        return;
    }
    QString fault;
    const auto openFor = [&](auto &opening) { open(connection, std::move(opening)); };
    switch (messages::dispatch(messages::Openings(), message, openFor, &fault)) {
    case messages::Dispatch::Delivered:
        break;
    case messages::Dispatch::Malformed:
        reject(connection, messages::errorWord::malformedMessage, fault);
        break;
    case messages::Dispatch::Unknown:
        Q_EMIT received(connection, message);
        break;
    }
}

void MasterServer::receiveGarbage(MasterConnection *connection)
{
    reject(connection, messages::errorWord::malformedMessage, connection->socket->errorString());
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "MasterServer.h"

#include "Logging.h"
#include "protocol/ControlFrame.h"
#include "signals/Fnv1a.h"

#include <QtCore/QJsonArray>
#include <QtCore/QPointer>
#include <QtCore/QRandomGenerator>
#include <QtNetwork/QUdpSocket>

#include <algorithm>

namespace qplc {

using Message = QPlcMessage;

namespace {

constexpr quint32 LongestGreeting = 64 * 1024;  // [byte]

/// Extensions that are in use: those that the other side names in its Hello, and that are known here.
QJsonArray commonFeatures(const Message &hello)
{
    QJsonArray common;
    const QJsonArray offered = hello.fields().value(QStringLiteral("features")).toArray();
    for (const char *known : {"sameCycle", "leases", "events", "quality"}) {
        const QString feature = QString::fromLatin1(known);
        if (offered.contains(feature))
            common.append(feature);
    }
    return common;
}

}  // namespace

MasterServer::MasterServer(NodeRegistry &registry, const ProcessImage &image, CyclicHub &hub, quint64 session,
                           std::function<QJsonObject()> hello, QObject *parent)
    : QObject(parent)
    , m_registry(registry)
    , m_image(image)
    , m_hub(hub)
    , m_session(session)
    , m_hello(std::move(hello))
{
    connect(&m_door, &MasterDoor::entered, this, &MasterServer::enter);
    connect(&m_door, &MasterDoor::refused, this, &MasterServer::strangerRefused);
    connect(&m_door, &MasterDoor::tooSlow, this, &MasterServer::dropSlow);
}

MasterServer::~MasterServer()
{
    close();
}

// ---- ports ----

bool MasterServer::openPorts(const QHostAddress &address, quint16 port)
{
    if (!m_door.listen(address, port)) {
        m_errorString
            = QStringLiteral("cannot listen on %1:%2: %3; choose another port, or end the program that uses it")
                  .arg(address.toString())
                  .arg(port)
                  .arg(m_door.errorString());
        return false;
    }
    if (m_hub.open(SocketAddress(m_door.address(), m_door.port()), &m_errorString) && m_hub.openLocal(&m_errorString))
        return true;
    m_door.close();
    return false;
}

bool MasterServer::listen(const QHostAddress &address, quint16 port, const QString &name, const QHostAddress &group)
{
    close();
    // A free TCP port may be taken on UDP: with port 0 another one will do.
    for (int attempts = port == 0 ? 16 : 1; attempts > 0; --attempts) {
        if (!openPorts(address, port))
            continue;
        if ((name.isEmpty() || m_name.hold(name, this->port(), &m_errorString)) && openMulticast(address, group))
            return true;
        close();
        return false;
    }
    return false;
}

bool MasterServer::openMulticast(const QHostAddress &address, const QHostAddress &group)
{
    m_group = SocketAddress();
    if (group.isNull())
        return true;
    if (!group.isMulticast() || group.protocol() != QAbstractSocket::IPv4Protocol) {
        m_errorString = QStringLiteral("%1 is no multicast group of IPv4; use one of 239.0.0.0 ... 239.255.255.255")
                            .arg(group.toString());
        return false;
    }
    QUdpSocket finder;  // a port of its own: nodes of this machine share it with each other, not with the server
    finder.bind(QHostAddress::AnyIPv4, 0);
    m_group = SocketAddress(group, finder.localPort());
    return m_hub.openMulticast(address, &m_errorString);
}

void MasterServer::close()
{
    m_name.release();
    m_door.close();
    for (const std::unique_ptr<MasterConnection> &connection : m_connections)
        connection->send(Message::MasterEnds);
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
    connect(socket, &QPlcAbstractSocket::errorOccurred, this, [this, connection](QPlcAbstractSocket::Error error) {
        if (error == QPlcAbstractSocket::ProtocolError)
            receiveGarbage(connection);
    });
    // Not at once: a message that cannot be sent ends the connection, and who sends to many of them walks over m_connections.
    const QPointer<QPlcSlaveSocket> guarded(socket);
    connect(
        socket, &QPlcAbstractSocket::disconnected, this, [this, guarded] { dropClosed(guarded); },
        Qt::QueuedConnection);
    if (peer.isSecured)
        Q_EMIT authenticated(connection);
}

void MasterServer::dropSlow(ConnectionGate::Ticket ticket)
{
    const auto isIt
        = [ticket](const std::unique_ptr<MasterConnection> &connection) { return connection->ticket == ticket; };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isIt);
    if (found != m_connections.end())
        reject(found->get(), QStringLiteral("TimedOut"), QStringLiteral("it has not greeted in time"));
}

void MasterServer::dropClosed(const QPlcSlaveSocket *socket)
{
    const auto isIt
        = [socket](const std::unique_ptr<MasterConnection> &connection) { return connection->socket == socket; };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isIt);
    if (found == m_connections.end())
        return;  // dropped meanwhile
    const QString error = socket->errorString();
    drop(found->get(), error.isEmpty() ? QStringLiteral("it closed the connection") : error);
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
    connection->socket->disconnect(this);
    connection->socket->deleteLater();
    const auto isIt
        = [connection](const std::unique_ptr<MasterConnection> &other) { return other.get() == connection; };
    m_connections.erase(std::remove_if(m_connections.begin(), m_connections.end(), isIt), m_connections.end());
}

void MasterServer::reject(MasterConnection *connection, const QString &error, const QString &reason)
{
    const QString text = printable(reason);
    connection->send(Message::Rejected, {{QStringLiteral("error"), error}, {QStringLiteral("text"), text}});
    Q_EMIT refused(connection->name, connection->socket->peerName(), text);
    drop(connection, text);
}

/// A request is refused, and the connection stays; before the greeting there is nothing that could stay.
void MasterServer::deny(MasterConnection *connection, const QString &reason)
{
    ++m_deniedMessages;
    Q_EMIT denied(connection, reason);
    if (connection->stage == MasterConnection::Silent || connection->peer.isCyclicOnly)
        reject(connection, QStringLiteral("Denied"), reason);
    else
        connection->fail(QStringLiteral("Denied"), reason);
}

/// The one place where control messages come in.
void MasterServer::receive(MasterConnection *connection, const Message &message)
{
    const QString refusal = refusalOf(connection->peer, message);
    if (!refusal.isEmpty()) {
        deny(connection, refusal);
        return;
    }
    if (connection->peer.isSecured && isCommand(message.kind()))
        Q_EMIT commanded(connection, message);
    switch (message.kind()) {
    case Message::Hello:
        greet(connection, message);
        return;
    case Message::AttachCyclicChannel:
        attachCyclicChannel(connection, message);
        return;
    default:
        break;
    }
    if (connection->stage == MasterConnection::Silent) {
        reject(connection, QStringLiteral("WrongState"),
               QStringLiteral("%1 before Hello; greet first").arg(message.kindName()));
        return;
    }
    if (message.kind() == Message::Register)
        registerNode(connection, message);
    else
        Q_EMIT received(connection, message);
}

void MasterServer::receiveGarbage(MasterConnection *connection)
{
    reject(connection, QStringLiteral("MalformedMessage"), connection->socket->errorString());
}

// ---- registration ----

void MasterServer::greet(MasterConnection *connection, const Message &message)
{
    if (connection->stage != MasterConnection::Silent) {
        reject(connection, QStringLiteral("WrongState"), QStringLiteral("'%1' greets twice").arg(connection->name));
        return;
    }
    const int protocol = message.fields().value(QStringLiteral("protocol")).toInt();
    connection->name = printable(message.text(QStringLiteral("name")));
    connection->uuid = message.text(QStringLiteral("uuid"));
    if (protocol != 1) {
        reject(connection, QStringLiteral("VersionMismatch"),
               QStringLiteral("protocol version %1 of '%2' is not spoken here; this master speaks version 1")
                   .arg(protocol)
                   .arg(connection->name));
        return;
    }
    QJsonObject hello = m_hello();
    const QJsonArray features = commonFeatures(message);
    hello.insert(QStringLiteral("features"), features);
    if (message.hex64(QStringLiteral("tableHash")) == m_image.table().hash())
        hello.remove(QStringLiteral("table"));
    connection->stage = MasterConnection::Greeted;
    connection->socket->setMessageLimit(MaximumControlFrame);
    m_door.know(connection->ticket);
    connection->wantsLeases = features.contains(QStringLiteral("leases"));
    connection->wantsEvents = features.contains(QStringLiteral("events"));
    Q_EMIT greeted(connection);
    if (!connection->send(Message::Hello, hello))
        reject(connection, QStringLiteral("TooLong"),
               QStringLiteral("the signal table is too long to be sent; give '%1' the same table as the master")
                   .arg(connection->name));
}

void MasterServer::registerNode(MasterConnection *connection, const Message &message)
{
    if (connection->isNode()) {
        reject(connection, QStringLiteral("WrongState"),
               QStringLiteral("node '%1' registers twice").arg(connection->name));
        return;
    }
    NodeDeclaration declaration;
    Refusal refusal;
    QString error;
    connection->cyclicKind = message.text(QStringLiteral("cyclic"));
    const int udpPort = message.fields().value(QStringLiteral("udpPort")).toInt();
    const bool isMulticast = connection->cyclicKind == QLatin1String("udp-multicast");
    const bool isUdp = isMulticast || connection->cyclicKind == QLatin1String("udp");
    const bool isLocal = connection->cyclicKind == QLatin1String("local");
    if (!NodeDeclaration::fromMessage(message, &declaration, &error))
        refusal = {QStringLiteral("MalformedMessage"), error};
    else if (Refusal channel = channelRefusal(*connection, declaration, udpPort); !channel.error.isEmpty())
        refusal = channel;
    else {
        replace(connection, declaration.name);
        connection->slot = m_registry.admit(declaration, &refusal);
    }
    if (!connection->slot) {
        connection->name = declaration.name.isEmpty() ? connection->name : printable(declaration.name);
        reject(connection, refusal.error, refusal.text);
        return;
    }
    connection->name = declaration.name;
    if (isMulticast && connection->slot->inputLayout.size() > MulticastParts::MaximumInputs) {
        reject(
            connection, QStringLiteral("TooLong"),
            QStringLiteral("node '%1' has %2 bytes of inputs, more than the %3 of a datagram for many nodes; use udp")
                .arg(declaration.name)
                .arg(connection->slot->inputLayout.size())
                .arg(MulticastParts::MaximumInputs));
        return;
    }
    connection->slot->faultPlan = printable(message.text(QStringLiteral("faults"))).left(200);
    connection->slot->prepare(m_image, m_session);
    connection->token = QRandomGenerator::system()->generate64();
    connection->stage = MasterConnection::Attaching;
    QJsonObject fields{{QStringLiteral("node"), connection->slot->id},
                       {QStringLiteral("inputsHash"), Message::fromHex64(connection->slot->inputLayout.hash())},
                       {QStringLiteral("outputsHash"), Message::fromHex64(connection->slot->outputLayout.hash())},
                       {QStringLiteral("state"), m_hello().value(QStringLiteral("state"))},
                       {QStringLiteral("token"), Message::fromHex64(connection->token)}};
    if (isLocal && !makeLocalPeer(connection, &fields))
        return;
    if (isUdp)
        connection->slot->peer = HubPeer::udp(SocketAddress(connection->socket->peerAddress(), quint16(udpPort)));
    connection->slot->wantsMulticast = isMulticast;
    if (isMulticast) {
        fields.insert(QStringLiteral("group"), QHostAddress(m_group.data()).toString());
        fields.insert(QStringLiteral("groupPort"), m_group.port());
    }
    connection->send(Message::Registered, fields);
    if (!isUdp && !isLocal)
        return;
    connection->send(Message::CyclicChannelAttached);
    nodeAttached(connection);
}

/// Why there can be no cyclic channel as the node wants it; no error: there can.
Refusal MasterServer::channelRefusal(const MasterConnection &connection, const NodeDeclaration &declaration,
                                     int udpPort) const
{
    const QString &kind = connection.cyclicKind;
    const bool isMulticast = kind == QLatin1String("udp-multicast");
    const bool isUdp = isMulticast || kind == QLatin1String("udp");
    if (kind == QLatin1String("local") && !connection.socket->peerAddress().isLoopback())
        return {QStringLiteral("MalformedMessage"),
                QStringLiteral("a local node runs on the machine of its master; use udp")};
    if (!isUdp && kind != QLatin1String("local") && kind != QLatin1String("tcp"))
        return {QStringLiteral("MalformedMessage"),
                QStringLiteral("unknown cyclic channel '%1'; use tcp, udp, udp-multicast or local").arg(kind)};
    if (isUdp && (udpPort < 1 || udpPort > 65535))
        return {QStringLiteral("MalformedMessage"), QStringLiteral("UDP port %1 is out of 1 ... 65535").arg(udpPort)};
    if (isMulticast && m_group.length == 0)
        return {QStringLiteral("WrongState"),
                QStringLiteral("this master has no multicast group; give it one, or use udp")};
    if (isMulticast && declaration.isOrdered())
        return {QStringLiteral("WrongState"),
                QStringLiteral("node '%1' has same-cycle inputs or two phases: it is asked alone; use udp")
                    .arg(declaration.name)};
    if (isMulticast && !declaration.interval.isEveryCycle())
        return {QStringLiteral("WrongState"),
                QStringLiteral("node '%1' wants one of %2 cycles: it is asked alone; use udp")
                    .arg(declaration.name)
                    .arg(declaration.interval.cycles())};
    return {};
}

/// \return false when there is no shared memory: the node has been refused
bool MasterServer::makeLocalPeer(MasterConnection *connection, QJsonObject *fields)
{
    QString error;
    auto memory = std::make_unique<SharedMemory>();
    if (!memory->create(sizeof(SharedChannel), &error)) {
        reject(connection, QStringLiteral("NodeError"), error);
        return false;
    }
    const CyclicHub::LocalPaths paths = m_hub.localPaths();
    fields->insert(QStringLiteral("channel"), memory->path());
    fields->insert(QStringLiteral("doorbell"), paths.doorbell);
    fields->insert(QStringLiteral("pipe"), paths.pipe);
    connection->slot->peer = HubPeer::local(std::move(memory));
    return true;
}

/// A node that comes back before its last connection is known to be dead takes its own place.
void MasterServer::replace(const MasterConnection *newcomer, const QString &name)
{
    const auto isItself = [&](const std::unique_ptr<MasterConnection> &other) {
        return other->isNode() && other->name == name && other->uuid == newcomer->uuid && !newcomer->uuid.isEmpty()
            && other->peer.identity == newcomer->peer.identity;
    };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isItself);
    if (found != m_connections.end())
        drop(found->get(), QStringLiteral("it registers again"));
}

void MasterServer::attachCyclicChannel(MasterConnection *connection, const Message &message)
{
    const quint64 token = message.hex64(QStringLiteral("token"));
    const int id = message.fields().value(QStringLiteral("node")).toInt();
    const auto isNode = [&](const std::unique_ptr<MasterConnection> &other) {
        return other->stage == MasterConnection::Attaching && other->slot->id == id && other->token == token;
    };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isNode);
    if (connection->stage != MasterConnection::Silent || found == m_connections.end()) {
        reject(connection, QStringLiteral("WrongState"),
               QStringLiteral("no node %1 with this token waits for its cyclic connection").arg(id));
        return;
    }
    MasterConnection *node = found->get();
    connection->send(Message::CyclicChannelAttached);
    const int descriptor = connection->socket->takeDescriptor();
    forget(connection);
    if (descriptor < 0)
        return;
    node->slot->peer = HubPeer::tcp(descriptor, node->slot->outputCutter(), MaximumCyclicFrame);
    nodeAttached(node);
}

void MasterServer::nodeAttached(MasterConnection *connection)
{
    connection->slot->peer->owner = connection->slot.get();
    connection->slot->peer->isListener = connection->slot->listener;
    m_hub.exposeToFaults(*connection->slot->peer, ~fnv1a64(connection->name.toUtf8()));  // not those of the node itself
    connection->stage = MasterConnection::Attached;
    Q_EMIT attached(connection);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
// The registration of nodes at MasterServer: from the greeting to the cyclic channel that is there.
#include "MasterServer.h"
#include "node/Logging.h"
#include "node/security/SealFields.h"
#include "protocol/ControlFrame.h"
#include "signals/Fnv1a.h"
#include "transport/StreamTransport.h"

#include <QtCore/QJsonArray>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTimer>

#include <algorithm>

namespace qplc {

using Message = QPlcMessage;

namespace {

constexpr std::chrono::seconds LongestAttaching{5};  // until the cyclic connection of a node is there
constexpr int LongestUuid = 64;                      // [characters] twice as many as there are

/// As somebody calls himself, fit to be shown and kept.
QString nameOf(const QString &given)
{
    return printable(given.left(NodeDeclaration::LongestName));
}

/// For one registration. Memory that node and master share needs none: who may open it may look into both programs anyway.
std::optional<SealKeys> newSealKeys(const MasterConnection &connection)
{
    if (!connection.isSecured() || connection.cyclicKind == QLatin1String("local"))
        return std::nullopt;
    return SealKeys::random();
}

/// Extensions that are in use: those that the other side names in its Hello, and that are known here.
QStringList commonFeatures(const Message &hello)
{
    QStringList common;
    const QJsonArray offered = hello.fields().value(QStringLiteral("features")).toArray();
    for (const char *known : {"sameCycle", "leases", "events", "quality", "outputQuality", "hardware"}) {
        const QString feature = QString::fromLatin1(known);
        if (offered.contains(feature))
            common.append(feature);
    }
    return common;
}

}  // namespace

void MasterServer::greet(MasterConnection *connection, const Message &message)
{
    if (connection->stage != MasterConnection::Silent) {
        reject(connection, QStringLiteral("WrongState"), QStringLiteral("'%1' greets twice").arg(connection->name));
        return;
    }
    const int protocol = message.fields().value(QStringLiteral("protocol")).toInt();
    connection->name = nameOf(message.text(QStringLiteral("name")));
    connection->uuid = message.text(QStringLiteral("uuid")).left(LongestUuid);
    if (protocol != 1) {
        reject(connection, QStringLiteral("VersionMismatch"),
               QStringLiteral("protocol version %1 of '%2' is not spoken here; this master speaks version 1")
                   .arg(protocol)
                   .arg(connection->name));
        return;
    }
    messages::MasterHello hello = m_hello();
    hello.features = commonFeatures(message);
    if (connection->peer.isSecured) {
        hello.identity = connection->peer.identity;
        hello.role = roleName(connection->peer.role);
    }
    if (message.hex64(QStringLiteral("tableHash")) != m_image.table().hash())
        hello.table = m_tableText;
    connection->stage = MasterConnection::Greeted;
    connection->socket->setMessageLimit(MaximumControlFrame);
    m_door.know(connection->ticket);
    connection->wantsLeases = hello.features.contains(QStringLiteral("leases"));
    connection->wantsEvents = hello.features.contains(QStringLiteral("events"));
    connection->isHardware = hello.features.contains(QStringLiteral("hardware"));
    Q_EMIT greeted(connection);
    if (!connection->send(hello))
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
        declaration.hardware = connection->isHardware;
        refusal = m_objection(declaration);
        if (refusal.error.isEmpty())
            connection->slot = m_registry.admit(declaration, &refusal);
    }
    if (!connection->slot) {
        connection->name = declaration.name.isEmpty() ? connection->name : nameOf(declaration.name);
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
    const std::optional<SealKeys> keys = newSealKeys(*connection);
    connection->slot->prepare(m_image, m_session, keys ? &*keys : nullptr);
    connection->token = QRandomGenerator::system()->generate64();
    connection->stage = MasterConnection::Attaching;
    messages::Registered registered;
    registered.node = connection->slot->id;
    registered.inputsHash = connection->slot->inputLayout.hash();
    registered.outputsHash = connection->slot->outputLayout.hash();
    registered.state = m_hello().state;
    registered.token = connection->token;
    if (keys)
        registered.seal = sealOf(*keys);
    if (isLocal && !makeLocalPeer(connection, &registered))
        return;
    if (isUdp)
        connection->slot->peer = UdpTransport::peer(SocketAddress(connection->socket->peerAddress(), quint16(udpPort)));
    connection->slot->wantsMulticast = isMulticast;
    if (isMulticast) {
        registered.group = QHostAddress(m_group.data()).toString();
        registered.groupPort = m_group.port();
    }
    connection->send(registered);
    if (!isUdp && !isLocal) {
        dropUnattached(connection);
        return;
    }
    connection->send(messages::CyclicChannelAttached());
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
    if (isMulticast && connection.isSecured())
        return {QStringLiteral("WrongState"),
                QStringLiteral("a secured master sends no datagrams for many nodes; use udp")};
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
bool MasterServer::makeLocalPeer(MasterConnection *connection, messages::Registered *registered)
{
    QString error;
    auto memory = std::make_unique<SharedMemory>();
    if (!memory->create(sizeof(SharedChannel), &error)) {
        reject(connection, QStringLiteral("NodeError"), error);
        return false;
    }
    const LocalTransport::Paths paths = m_hub.localPaths();
    registered->channel = memory->path();
    registered->doorbell = paths.doorbell;
    registered->pipe = paths.pipe;
    connection->slot->peer = LocalTransport::peer(std::move(memory));
    return true;
}

/// Who registers and does not attach keeps a name and signals from others: not for ever.
void MasterServer::dropUnattached(const MasterConnection *connection)
{
    QTimer::singleShot(LongestAttaching, connection->socket, [this, socket = connection->socket] {
        MasterConnection *late = connectionOf(socket);
        if (late && late->stage == MasterConnection::Attaching)
            reject(late, QStringLiteral("TimedOut"),
                   QStringLiteral("node '%1' has not attached its cyclic connection in time").arg(late->name));
    });
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
    connection->send(messages::CyclicChannelAttached());
    const int descriptor = connection->socket->takeDescriptor();
    forget(connection);
    if (descriptor < 0)
        return;
    node->slot->peer = StreamTransport::peer(descriptor, node->slot->outputCutter(), MaximumCyclicFrame);
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

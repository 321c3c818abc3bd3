// SPDX-License-Identifier: Apache-2.0
// The registration of nodes at MasterServer: from the greeting to the cyclic channel that is there.
#include "MasterServer.h"
#include "PacedReading.h"
#include "node/Logging.h"
#include "node/security/SealFields.h"
#include "protocol/ControlFrame.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/Host.h"
#include "signals/Fnv1a.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <utility>

namespace qplc {

namespace {

constexpr std::chrono::seconds LongestAttaching{5};  // until the cyclic connection of a node is there
constexpr int LongestUuid = 64;                      // [characters] twice as many as there are

bool hasSealedFrames(const MasterConnection &connection)
{
    return connection.isSecured() && connection.transport->isSealed();
}

/// For one registration.
std::optional<SealKeys> newSealKeys(const MasterConnection &connection)
{
    if (!hasSealedFrames(connection))
        return std::nullopt;
    return SealKeys::make([] { return Host::current().random(); });
}

/// Not before the slot is there.
CycleVolume volumeOf(const MasterConnection &connection)
{
    if (!connection.slot)
        return {};
    return {frameVolume(connection.slot->inputLayout, hasSealedFrames(connection)),
            frameVolume(connection.slot->outputLayout, hasSealedFrames(connection))};
}

/// Extensions that are in use: those that the other side names in its Hello, and that are known
/// here.
QStringList commonFeatures(const messages::ClientHello &greeting)
{
    QStringList common;
    for (QLatin1String known : messages::feature::all) {
        if (greeting.features.contains(known))
            common.append(known);
    }
    return common;
}

/// How \a registration contradicts the greeting of its connection; no error: it does not.
Refusal contradictionOf(const MasterConnection &connection, const NodeDeclaration &declaration,
                        const messages::Register &registration)
{
    const bool hasOtherUuid = !registration.uuid.isEmpty() && registration.uuid.left(LongestUuid) != connection.uuid;
    if (MasterServer::nameOf(registration.name) != connection.name || hasOtherUuid)
        return {messages::errorWord::malformedMessage,
                QStringLiteral("'%1' registers as '%2', or with another uuid than it greeted with; send those of Hello")
                    .arg(connection.name, MasterServer::nameOf(registration.name))};
    const std::pair<QLatin1String, bool> used[] = {{messages::feature::sameCycle, declaration.isOrdered()},
                                                   {messages::feature::quality, declaration.quality},
                                                   {messages::feature::outputQuality, declaration.outputQuality}};
    for (const auto &[feature, isUsed] : used) {
        if (isUsed && !connection.uses(feature))
            return {messages::errorWord::malformedMessage,
                    QStringLiteral("node '%1' uses '%2' and has not offered it; name it in 'features' of Hello")
                        .arg(connection.name, feature)};
    }
    return {};
}

/// Why the inputs of the node of \a connection are too long for it; no error: they are not.
Refusal sizeRefusal(const MasterConnection &connection, const NodeSlot &slot)
{
    const quint32 size = slot.inputLayout.size();
    if (connection.transport->hasGroup() && size > MulticastParts::MaximumInputs)
        return {
            messages::errorWord::tooLong,
            QStringLiteral("node '%1' has %2 bytes of inputs, more than the %3 of a datagram for many nodes; use udp")
                .arg(connection.name)
                .arg(size)
                .arg(MulticastParts::MaximumInputs)};
    constexpr quint32 longest = MaximumControlFrame / 4 * 3 - 1024;  // [byte] of values in InitializeWithValues
    if (size > longest)
        return {messages::errorWord::tooLong,
                QStringLiteral("node '%1' has %2 bytes of inputs, more than the %3 of a message; divide it")
                    .arg(connection.name)
                    .arg(size)
                    .arg(longest)};
    return {};
}

/// What a node that has registered over \a kind may choose by \a name. Null: not this one.
const TransportKind *chosenKind(const TransportKind &kind, const QString &name)
{
    for (const TransportKind *each : {&kind, kind.first(), kind.fallback()}) {
        if (each && !each->first() && (name.isEmpty() ? each == &kind : each->name() == name))
            return each;
    }
    return nullptr;
}

/// Tells in which direction to look for the cause.
QString reasonForFallback(const MasterConnection &node)
{
    return QStringLiteral("%1 does not get through (datagrams of the node that reached the master: %2)")
        .arg(node.transport->first()->name().toUpper())
        .arg(node.probe ? node.probe->questions() : 0);
}

/// Why a node may not use what it has chosen; no error: it may.
Refusal refusalOfChoice(const MasterConnection &node, const TransportKind &kind)
{
    if (&kind != node.transport->fallback())
        return node.firstRefusal;
    Refusal refusal = node.fallbackRefusal;
    if (!refusal.error.isEmpty())
        refusal.text += QStringLiteral("; ") + reasonForFallback(node);
    return refusal;
}

/// Who gets the last connections.
ConnectionGate::Guest guestOf(const MasterConnection &connection, const messages::ClientHello &greeting)
{
    const bool isMere
        = connection.peer.isSecured ? connection.peer.role == Role::Observer : greeting.role != messages::Part::Node;
    return isMere ? ConnectionGate::Observer : ConnectionGate::NodeOrOperator;
}

}  // namespace

QString MasterServer::nameOf(const QString &given)
{
    return printable(given.left(NodeDeclaration::LongestName));
}

void MasterServer::open(MasterConnection *connection, const messages::ClientHello &greeting)
{
    if (connection->stage != MasterConnection::Silent) {
        reject(connection, messages::errorWord::wrongState, QStringLiteral("'%1' greets twice").arg(connection->name));
        return;
    }
    connection->name = nameOf(greeting.name);
    connection->uuid = greeting.uuid.left(LongestUuid);
    const Refusal evicted = m_evictions.refusalOf(connection->name, connection->peer);
    if (!evicted.error.isEmpty()) {
        reject(connection, evicted.error, evicted.text);
        return;
    }
    if (greeting.protocol != messages::protocolVersion) {
        reject(connection, messages::errorWord::versionMismatch,
               QStringLiteral("protocol version %1 of '%2' is not spoken here; this master speaks version %3")
                   .arg(greeting.protocol)
                   .arg(connection->name)
                   .arg(messages::protocolVersion));
        return;
    }
    if (!m_door.know(connection->ticket, guestOf(*connection, greeting))) {
        reject(connection, messages::errorWord::tooMuch,
               QStringLiteral("too many connections: the last ones are for nodes and operators; end tools that are not "
                              "needed"));
        return;
    }
    messages::MasterHello hello = m_hello();
    hello.features = commonFeatures(greeting);
    if (connection->peer.isSecured) {
        hello.identity = connection->peer.identity;
        hello.role = roleName(connection->peer.role);
    }
    hello.longestMessage = m_longestMessage;
    connection->stage = MasterConnection::Greeted;
    connection->socket->setMessageLimit(m_longestMessage);
    connection->socket->setSendLimit(MaximumControlFrame);
    connection->features = hello.features;
    Q_EMIT greeted(connection);
    const bool needsTable
        = greeting.wantsTable && greeting.tableHash.value_or(messages::Hex64()) != m_image.table().hash();
    const QByteArray text
        = needsTable ? messages::HelloText::beforeTable(hello) : messages::HelloText::withoutTable(hello);
    if (!PacedReading::send(*connection->socket, hello.kind, text, needsTable ? m_greeting.table() : QByteArray()))
        reject(connection, messages::errorWord::tooLong,
               QStringLiteral("the signal table is too long to be sent; give '%1' the same table as the master")
                   .arg(connection->name));
}

void MasterServer::open(MasterConnection *connection, messages::Register registration)
{
    open(connection, std::make_shared<const messages::Register>(std::move(registration)));
}

void MasterServer::open(MasterConnection *connection, const std::shared_ptr<const messages::Register> &registration)
{
    if (connection->isNode()) {
        reject(connection, messages::errorWord::wrongState,
               QStringLiteral("node '%1' registers twice").arg(connection->name));
        return;
    }
    const std::size_t most = std::size_t(m_image.table().size());
    if (registration->inputs.size() > most || registration->outputs.size() > most) {
        reject(connection, messages::errorWord::malformedMessage,
               QStringLiteral("node '%1' declares %2 inputs and %3 outputs, and the table has %4 signals; declare each "
                              "of them once")
                   .arg(connection->name)
                   .arg(registration->inputs.size())
                   .arg(registration->outputs.size())
                   .arg(most));
        return;
    }
    const QString denial = refusalOf(connection->peer, *registration);
    if (denial.isEmpty())
        connection->nextStep = [this, connection, registration] { admit(connection, registration); };
    else
        deny(connection, denial, true);
}

/// What can be said against a registration without the other nodes. To compare thousands of signals
/// with the table takes long: that of a long message is done where it was read.
void MasterServer::admit(MasterConnection *connection, const std::shared_ptr<const messages::Register> &registration)
{
    const auto newNode = std::make_shared<NewNode>();
    newNode->registration = registration;
    NodeDeclaration &declaration = newNode->declaration;
    Refusal &refusal = newNode->refusal;
    QString error;
    connection->cyclicKind = registration->cyclic;
    connection->transport = TransportRegistry::instance().named(connection->cyclicKind);
    if (!NodeDeclaration::fromMessage(*registration, &declaration, &error)) {
        refusal = {messages::errorWord::malformedMessage, error};
    } else {
        declaration.hardware = connection->uses(messages::feature::hardware);
        refusal = contradictionOf(*connection, declaration, *registration);
        if (refusal.error.isEmpty())
            refusal = m_evictions.refusalOf(declaration.name, connection->peer);
        if (refusal.error.isEmpty())
            refusal = transportRefusal(connection, &declaration);
        if (refusal.error.isEmpty())
            refusal = channelRefusal(*connection, newcomer(*connection, declaration, *registration));
    }
    if (!refusal.error.isEmpty()) {
        rejectNode(connection, *newNode);
        return;
    }
    const auto make = [this, newNode] { newNode->slot = m_registry.make(newNode->declaration, &newNode->refusal); };
    if (!connection->longRead) {
        make();
        enlist(connection, *newNode);
        return;
    }
    connection->longRead->stage = LongRead::Begun;
    const QPointer<QPlcSlaveSocket> socket(connection->socket);
    m_reader.begin(make, [this, socket, newNode] {
        MasterConnection *waiting = socket ? connectionOf(socket) : nullptr;
        if (!waiting)
            return;
        waiting->longRead->stage = LongRead::Given;
        waiting->nextStep = [this, waiting, newNode] { enlist(waiting, *newNode); };
        arrived(waiting);
    });
}

void MasterServer::rejectNode(MasterConnection *connection, const NewNode &newNode)
{
    const QString &name = newNode.declaration.name;
    connection->name = name.isEmpty() ? connection->name : nameOf(name);
    reject(connection, newNode.refusal.error, newNode.refusal.text);
}

/// The node takes its place among the others, unless it was refused.
void MasterServer::enlist(MasterConnection *connection, NewNode &newNode)
{
    const NodeDeclaration &declaration = newNode.declaration;
    const messages::Register &registration = *newNode.registration;
    std::optional<SealKeys> keys;
    if (const std::shared_ptr<NodeSlot> &slot = newNode.slot) {
        slot->id = m_registry.freeId();
        slot->transport = connection->transport;
        slot->faultPlan = printable(registration.faults).left(200);
        keys = newSealKeys(*connection);
        slot->prepare(m_image, m_session, keys ? &*keys : nullptr);
        newNode.refusal = sizeRefusal(*connection, *slot);
        if (newNode.refusal.error.isEmpty())
            replace(connection, declaration.name);
        if (newNode.refusal.error.isEmpty() && m_registry.add(slot, &newNode.refusal))
            connection->slot = slot;
    }
    if (!connection->slot) {
        rejectNode(connection, newNode);
        return;
    }
    connection->name = declaration.name;
    connection->token = Host::current().random();
    connection->stage = MasterConnection::Attaching;
    messages::Registered registered;
    registered.node = connection->slot->id;
    registered.inputsHash = connection->slot->inputLayout.hash();
    registered.outputsHash = connection->slot->outputLayout.hash();
    registered.state = m_hello().state;
    registered.token = connection->token;
    if (keys)
        registered.seal = sealOf(*keys);
    connection->newcomer = std::make_unique<Newcomer>(newcomer(*connection, declaration, registration));
    if (!prepareChannel(connection, &registered))
        return;
    connection->send(registered);
    if (connection->slot->peer) {
        connection->send(messages::CyclicChannelAttached());
        nodeAttached(connection);
    } else {
        dropUnattached(connection);
    }
}

/// Whether the master takes the node over its transport. One of two is enough.
Refusal MasterServer::transportRefusal(MasterConnection *connection, NodeDeclaration *declaration) const
{
    const TransportKind *kind = connection->transport;
    if (!kind || !kind->first())
        return m_objection(declaration, *connection, connection->cyclicKind);
    connection->firstRefusal = m_objection(declaration, *connection, kind->first()->name());
    connection->fallbackRefusal = m_objection(declaration, *connection, kind->fallback()->name());
    return connection->firstRefusal.error.isEmpty() ? Refusal() : connection->fallbackRefusal;
}

/// Makes the peer, unless the node has to attach first. \return false when it is rejected
bool MasterServer::prepareChannel(MasterConnection *connection, messages::Registered *registered)
{
    const TransportKind &kind = *connection->transport;
    if (!kind.first())
        return kind.hasStreams() || makePeer(connection, registered);
    if (!connection->firstRefusal.error.isEmpty())
        return true;  // without a probe, the node uses the fallback
    const ProbeNumbers numbers{Host::current().random(), Host::current().random()};
    connection->probe = kind.first()->answerProbe(m_hub, *connection->newcomer, numbers);
    if (connection->probe)
        registered->probe = messages::Probe{numbers.question, numbers.answer};
    return true;
}

/// \return false when the node is rejected
bool MasterServer::makePeer(MasterConnection *node, messages::Registered *registered)
{
    ChannelError fault;
    node->slot->peer = node->transport->makePeer(m_hub, *node->newcomer, &registered->transport, &fault);
    if (!node->slot->peer)
        reject(node, fault.word, fault.text);
    return node->slot->peer != nullptr;
}

Newcomer MasterServer::newcomer(const MasterConnection &connection, const NodeDeclaration &declaration,
                                const messages::Register &registration) const
{
    return {declaration.name,        connection.socket->peerAddress(), connection.isSecured(),
            declaration.isOrdered(), declaration.interval.cycles(),    registration.transport,
            volumeOf(connection)};
}

/// Why there can be no cyclic channel as the node wants it; no error: there can.
Refusal MasterServer::channelRefusal(const MasterConnection &connection, const Newcomer &newcomer) const
{
    if (!connection.transport || !connection.transport->isAtHand())
        return {messages::errorWord::malformedMessage,
                QStringLiteral("unknown cyclic channel '%1'; use %2")
                    .arg(connection.cyclicKind, TransportRegistry::instance().namesText())};
    ChannelError error;
    if (connection.transport->admits(m_hub, newcomer, &error))
        return {};
    return {error.word, error.text};
}

/// Who registers and does not attach keeps a name and signals from others: not for ever.
void MasterServer::dropUnattached(const MasterConnection *connection)
{
    QTimer::singleShot(LongestAttaching, connection->socket, [this, socket = connection->socket] {
        MasterConnection *late = connectionOf(socket);
        if (late && late->stage == MasterConnection::Attaching)
            reject(late, messages::errorWord::timedOut,
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

void MasterServer::open(MasterConnection *connection, const messages::AttachCyclicChannel &wish)
{
    const auto isNode = [&](const std::unique_ptr<MasterConnection> &other) {
        return other->stage == MasterConnection::Attaching && other->slot->id == wish.node
            && other->token == wish.token;
    };
    const auto found = std::find_if(m_connections.begin(), m_connections.end(), isNode);
    MasterConnection *node = found == m_connections.end() ? nullptr : found->get();
    const TransportKind *kind = node ? chosenKind(*node->transport, wish.cyclic) : nullptr;
    const bool isItsConnection
        = kind && (kind->hasStreams() ? connection->stage == MasterConnection::Silent : connection == node);
    if (!isItsConnection) {
        reject(connection, messages::errorWord::wrongState,
               QStringLiteral("no node %1 with this token waits for its cyclic connection").arg(wish.node));
        return;
    }
    if (const Refusal refusal = refusalOfChoice(*node, *kind); !refusal.error.isEmpty()) {
        if (connection != node) {  // whichever of the two ends is seen first, the node knows why
            connection->send(messages::Rejected{refusal.error, refusal.text});
            drop(connection, refusal.text);
        }
        reject(node, refusal.error, refusal.text);
        return;
    }
    if (!kind->hasStreams()) {
        messages::Registered sentBefore;
        useTransport(node, *kind);
        if (!makePeer(node, &sentBefore))
            return;
        node->send(messages::CyclicChannelAttached());
        nodeAttached(node);
        return;
    }
    connection->send(messages::CyclicChannelAttached());
    const int descriptor = connection->socket->takeDescriptor();
    forget(connection);
    if (descriptor < 0)
        return;
    useTransport(node, *kind);
    node->slot->peer = kind->makeStreamPeer(descriptor, node->slot->outputCutter(), MaximumCyclicFrame);
    nodeAttached(node);
}

/// From now on the node has the transport that it has chosen.
void MasterServer::useTransport(MasterConnection *node, const TransportKind &kind) const
{
    if (node->transport->fallback() == &kind && node->firstRefusal.error.isEmpty())
        node->fallbackReason = QStringLiteral("%1: frames use %2").arg(reasonForFallback(*node), kind.name().toUpper());
    node->probe.reset();
    node->transport = node->slot->transport = &kind;
    node->cyclicKind = kind.name();
}

void MasterServer::nodeAttached(MasterConnection *connection)
{
    connection->slot->peer->owner = connection->slot.get();
    connection->slot->peer->isListener = connection->slot->listener;
    m_hub.exposeToFaults(*connection->slot->peer, ~fnv1a64(connection->name.toUtf8()));  // not those of the node itself
    connection->stage = MasterConnection::Attached;
    connection->newcomer.reset();
    m_door.trust(connection->ticket);
    Q_EMIT attached(connection);
}

}  // namespace qplc

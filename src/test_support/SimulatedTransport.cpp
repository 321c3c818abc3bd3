// SPDX-License-Identifier: Apache-2.0
#include "SimulatedTransport.h"

#include "Fiber.h"
#include "FrameWire.h"
#include "protocol/messages/Vocabulary.h"
#include "transport/ChoiceKind.h"
#include "transport/CyclicHub.h"
#include "transport/TransportRegistry.h"

#include <algorithm>
#include <vector>

namespace qplc {

namespace {

const QString portField = QStringLiteral("simPort");

SimulatedHost &ownHost()
{
    SimulatedHost *host = SimulatedHost::current();
    if (!host)
        qFatal("QPlcSimulator: a master is made outside of QPlcSimulatedHost::start(), where no host runs it; make it "
               "with host.start<QPlcMasterNode>(), or inside of host.call()");
    return *host;
}

class Peer final : public HubPeer
{
public:
    Peer(quint64 there, bool isStream)
        : key(there)
        , m_isStream(isStream)
    {
    }
    bool losesFrames() const override { return !m_isStream; }

    const quint64 key;  // of its FrameEnd

private:
    const bool m_isStream;
};

/// Answers before anything reaches the Hub.
class Answers final : public ProbeAnswers
{
public:
    Answers(quint64 node, quint64 master, const ProbeNumbers &numbers)
        : ProbeAnswers(numbers)
        , m_wire(ownHost().simulator().frameWire())
        , m_node(node)
        , m_master(master)
    {
        m_wire.divert(node, master, [this](FrameEnd &end, SimulatedFrame &question) {
            std::vector<char> bytes = question.bytes;
            if (answer(bytes.data(), bytes.size()))
                end.send(m_node, bytes.data(), bytes.size());
        });
    }
    ~Answers() override { m_wire.divert(m_node, m_master, {}); }

private:
    FrameWire &m_wire;
    const quint64 m_node;
    const quint64 m_master;
};

class Hub final : public HubTransport
{
public:
    Hub() { m_peers.reserve(MaximumPeers); }

    bool open(const SocketAddress &address, QString *) override
    {
        m_end = std::make_unique<FrameEnd>(m_host, address.port());
        return true;
    }
    void close() override { m_end.reset(); }
    bool owns(const HubPeer &peer) const noexcept override { return dynamic_cast<const Peer *>(&peer) != nullptr; }
    void attach(HubPeer *peer) noexcept override { m_peers.push_back(static_cast<Peer *>(peer)); }
    void detach(HubPeer *peer) noexcept override
    {
        m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    }
    std::size_t peerCount() const noexcept override { return m_peers.size(); }
    void addDescriptors(std::vector<pollfd> *) const override {}
    std::size_t descriptorCount() const noexcept override { return 0; }
    bool isIdle() const noexcept override { return false; }  // it is what lets a fiber wait

    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept override
    {
        m_end->send(static_cast<Peer *>(peer)->key, frame, size);
        return true;
    }
    bool waitAlone(std::int64_t timeout, bool *arrived) noexcept override
    {
        m_read = 0;
        if (timeout > 0 && !m_host.runningFiber())
            qFatal("QPlcSimulator: a step waits for other hosts outside of a thread, where virtual time stands still; "
                   "step in host.startThread([&] { ... })");
        if (m_end && timeout > 0)
            m_end->wait(m_host.now() + timeout);
        else if (timeout > 0)
            m_host.sleepUntil(m_host.now() + timeout);
        *arrived = m_end && !m_end->isEmpty();
        return true;
    }
    bool endWait(pollfd *) noexcept override
    {
        m_read = 0;
        return m_end && !m_end->isEmpty();
    }
    bool next(HubFrame *frame) noexcept override
    {
        while (m_end && m_read < FramesPerWait) {
            const SimulatedFrame *arrived = m_end->take();
            if (!arrived)
                return false;
            ++m_read;
            const auto sends = [arrived](const Peer *peer) { return peer->key == arrived->from; };
            const auto peer = std::find_if(m_peers.begin(), m_peers.end(), sends);
            if (peer != m_peers.end()) {
                *frame = {*peer, arrived->bytes.data(), arrived->bytes.size()};
                return true;
            }
            ++arrivals().strangers;
        }
        return false;
    }
    std::uint64_t unread() const override { return m_end ? m_end->unread() : 0; }
    quint64 key() const { return m_end->key(); }

private:
    SimulatedHost &m_host = ownHost();
    std::unique_ptr<FrameEnd> m_end;  // null: closed
    std::vector<Peer *> m_peers;
    std::size_t m_read = 0;  // frames since the last wait
};

class Link final : public CyclicLink
{
public:
    Link(quint16 port, quint64 master)
        : CyclicLink(-1)
        , m_end(ownHost(), port)
        , m_master(master)
    {
    }
    int descriptor() const noexcept override { return m_end.descriptor(); }
    void becomeReliable() { m_end.becomeReliable(); }
    Status receive(const char **frame, std::size_t *size) noexcept override
    {
        m_end.wait(Fiber::Never);
        return poll(frame, size);
    }
    Status poll(const char **frame, std::size_t *size) noexcept override
    {
        const SimulatedFrame *arrived = m_end.take();
        while (arrived && arrived->from != m_master)
            arrived = m_end.take();
        if (!arrived)
            return Nothing;
        *frame = arrived->bytes.data();
        *size = arrived->bytes.size();
        return Received;
    }
    bool send(const char *frame, std::size_t size) noexcept override
    {
        m_end.send(m_master, frame, size);
        return true;
    }

private:
    FrameEnd m_end;
    const quint64 m_master;
};

quint64 keyOfNode(const Newcomer &node)
{
    return SocketAddress(node.address, quint16(node.request.value(portField).toInt())).key();
}

}  // namespace

void SimulatedTransport::install()
{
    QString error;
    TransportRegistry &registry = TransportRegistry::instance();
    const QString datagrams = QStringLiteral("sim");
    const QString stream = QStringLiteral("sim-stream");
    if (registry.named(datagrams))
        return;
    registry.add(std::make_unique<SimulatedTransport>(false), &error);
    registry.add(std::make_unique<SimulatedTransport>(true), &error);
    registry.add(std::make_unique<ChoiceKind>(QStringLiteral("sim-auto"), datagrams, stream), &error);
}

std::unique_ptr<HubTransport> SimulatedTransport::makeHubTransport() const
{
    return m_isStream ? nullptr : std::make_unique<Hub>();  // one for both
}

bool SimulatedTransport::admits(const CyclicHub &, const Newcomer &node, ChannelError *error) const
{
    const int port = node.request.value(portField).toInt();
    if (port >= 1 && port <= 65535)
        return true;
    *error
        = {messages::errorWord::malformedMessage, QStringLiteral("simulated port %1 is out of 1 ... 65535").arg(port)};
    return false;
}

std::unique_ptr<HubPeer> SimulatedTransport::makePeer(const CyclicHub &, const Newcomer &node, QJsonObject *,
                                                      ChannelError *) const
{
    return std::make_unique<Peer>(keyOfNode(node), m_isStream);
}

std::unique_ptr<ProbeAnswers> SimulatedTransport::answerProbe(const CyclicHub &hub, const Newcomer &node,
                                                              const ProbeNumbers &numbers) const
{
    return std::make_unique<Answers>(keyOfNode(node), hub.find<Hub>()->key(), numbers);
}

bool SimulatedTransport::beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                                   QString *) const
{
    SimulatedHost &host = ownHost();
    const quint16 port = host.simulator().frameWire().freePort(host);
    request->insert(portField, int(port));
    *link = std::make_unique<Link>(port, ends.master.key());
    return true;
}

/// The link that was begun for "sim-auto" serves both.
bool SimulatedTransport::finishLink(const ControlEnds &, const QJsonObject &, std::unique_ptr<CyclicLink> *link,
                                    QString *) const
{
    if (m_isStream)
        static_cast<Link *>(link->get())->becomeReliable();
    return true;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/Field.h"
#include "protocol/messages/Vocabulary.h"
#include "transport/TransportKind.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <mutex>
#include <set>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

/// The end of the node: whole frames to and from its master.
class PairLink final : public qplc::CyclicLink
{
public:
    explicit PairLink(int descriptor)
        : CyclicLink(descriptor)  // closes it
    {
    }
    Status receive(const char **frame, std::size_t *size) noexcept override { return read(frame, size, 0); }
    Status poll(const char **frame, std::size_t *size) noexcept override { return read(frame, size, MSG_DONTWAIT); }
    bool send(const char *frame, std::size_t size) noexcept override
    {
        return ::send(m_descriptor, frame, size, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(size);
    }

private:
    Status read(const char **frame, std::size_t *size, int flags) noexcept
    {
        const ssize_t count = ::recv(m_descriptor, m_frame.data(), m_frame.size(), flags);
        if (count < 0 && isTransient(errno))
            return Nothing;
        *frame = m_frame.data();
        *size = count > 0 ? std::size_t(count) : 0;
        return count > 0 ? Received : Closed;
    }
    std::array<char, 2048> m_frame{};
};

/// One node as the master reaches it.
class PairPeer final : public qplc::HubPeer
{
public:
    PairPeer(int socket, const std::function<void()> &withdraw)
        : descriptor(socket)
        , m_withdraw(withdraw)
    {
    }
    ~PairPeer() override
    {
        m_withdraw();
        ::close(descriptor);
    }
    bool isClosed() const override { return closed; }

    const int descriptor;
    bool closed = false;

private:
    const std::function<void()> m_withdraw;  // what the node has not taken
};

/// All such nodes of one master.
class PairTransport final : public qplc::HubTransport
{
public:
    PairTransport() { m_peers.reserve(MaximumPeers); }  // the cycle thread allocates nothing
    bool open(const qplc::SocketAddress & /*address*/, QString * /*error*/) override { return true; }
    void close() override {}
    bool owns(const qplc::HubPeer &peer) const noexcept override { return dynamic_cast<const PairPeer *>(&peer); }
    void attach(qplc::HubPeer *peer) noexcept override
    {
        m_peers.push_back(static_cast<PairPeer *>(peer));
        m_next = m_peers.size();
    }
    void detach(qplc::HubPeer *peer) noexcept override
    {
        m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
        m_next = m_peers.size();
    }
    std::size_t peerCount() const noexcept override { return m_peers.size(); }
    void addDescriptors(std::vector<pollfd> *descriptors) const override
    {
        for (const PairPeer *peer : m_peers)
            descriptors->push_back({peer->closed ? -1 : peer->descriptor, POLLIN, 0});
    }
    std::size_t descriptorCount() const noexcept override { return m_peers.size(); }

    bool send(qplc::HubPeer *peer, const char *frame, std::size_t size) noexcept override
    {
        const int descriptor = static_cast<PairPeer *>(peer)->descriptor;
        const bool isSent = ::send(descriptor, frame, size, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(size);
        peer->sendFailures += isSent ? 0 : 1;
        return isSent;
    }
    bool endWait(pollfd *polled) noexcept override
    {
        m_polled = polled;
        m_next = 0;
        return std::any_of(polled, polled + m_peers.size(), [](const pollfd &each) { return each.revents != 0; });
    }
    bool next(qplc::HubFrame *frame) noexcept override
    {
        for (; m_next < m_peers.size(); ++m_next) {
            PairPeer *peer = m_peers[m_next];
            if (std::exchange(m_polled[m_next].revents, short(0)) == 0)
                continue;  // one frame for each event: what remains wakes the next wait
            const ssize_t count = ::recv(peer->descriptor, m_frame.data(), m_frame.size(), MSG_DONTWAIT);
            *frame = {peer, m_frame.data(), count > 0 ? std::size_t(count) : 0};
            if (count > 0)
                return true;
            peer->closed = count == 0 || (errno != EAGAIN && errno != EINTR);
            m_polled[m_next].fd = peer->closed ? -1 : peer->descriptor;
        }
        return false;
    }

private:
    std::vector<PairPeer *> m_peers;
    pollfd *m_polled = nullptr;  // of m_peers, in the same order
    std::size_t m_next = 0;      // to look at
    std::array<char, 2048> m_frame{};
};

/// The row: two connected sockets, for nodes in the process of their master.
class PairKind final : public qplc::TransportKind
{
public:
    QString name() const override { return QStringLiteral("pair"); }
    std::unique_ptr<qplc::HubTransport> makeHubTransport() const override { return std::make_unique<PairTransport>(); }
    bool admits(const qplc::CyclicHub & /*hub*/, const qplc::Newcomer &node, qplc::ChannelError *error) const override
    {
        if (node.address.isLoopback())
            return true;
        *error = {qplc::messages::errorWord::wrongState, QStringLiteral("'pair' is for nodes of one process; use udp")};
        return false;
    }
    std::unique_ptr<qplc::HubPeer> makePeer(const qplc::CyclicHub & /*hub*/, const qplc::Newcomer & /*node*/,
                                            QJsonObject *answer, qplc::ChannelError *error) const override
    {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
            *error
                = {qplc::messages::errorWord::nodeError, QStringLiteral("no sockets: %1").arg(qplc::systemErrorText())};
            return nullptr;
        }
        qplc::messages::addFields(Answer{ends[1]}, answer);
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_offered.insert(ends[1]);
        return std::make_unique<PairPeer>(ends[0], [this, end = ends[1]] { withdraw(end); });
    }
    bool finishLink(const qplc::ControlEnds & /*ends*/, const QJsonObject &answer,
                    std::unique_ptr<qplc::CyclicLink> *link, QString *error) const override
    {
        const int end = qplc::messages::fieldsOf<Answer>(answer).pairEnd;
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (m_offered.erase(end) == 0) {
            *error = QStringLiteral("the master is another process; use udp");
            return false;
        }
        *link = std::make_unique<PairLink>(end);
        return true;
    }

private:
    void withdraw(int end) const
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (m_offered.erase(end) > 0)
            ::close(end);
    }
    /// What the master adds to Registered.
    struct Answer
    {
        int pairEnd = -1;  // descriptor of the node's socket

        static constexpr auto fields = qplc::messages::fieldList(qplc::messages::field("pairEnd", &Answer::pairEnd));
    };
    mutable std::mutex m_mutex;
    mutable std::set<int> m_offered;  // ends that no node has taken yet
};

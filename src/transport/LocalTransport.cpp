// SPDX-License-Identifier: Apache-2.0
#include "LocalTransport.h"

#include <algorithm>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace qplc {

class LocalTransport::Peer final : public HubPeer
{
public:
    explicit Peer(std::unique_ptr<SharedChannel> shared)
        : channel(std::move(shared))
    {
    }

    const std::unique_ptr<SharedChannel> channel;
    bool isToBeWoken = false;
};

LocalTransport::LocalTransport()
{
    m_peers.reserve(MaximumPeers);
}

LocalTransport::~LocalTransport()
{
    for (const int descriptor : m_pipe) {
        if (descriptor >= 0)
            ::close(descriptor);
    }
}

std::unique_ptr<HubPeer> LocalTransport::peer(std::unique_ptr<SharedChannel> channel)
{
    return std::make_unique<Peer>(std::move(channel));
}

std::unique_ptr<HubPeer> LocalTransport::link(std::uint64_t key, const CycleVolume &volume, QString *error)
{
    auto channel = std::make_unique<SharedChannel>();
    if (!channel->create(volume, error)
        || !m_listener.pass(key, {channel->descriptor(), m_doorbell.descriptor(), m_pipe[1]}, error))
        return nullptr;
    return peer(std::move(channel));
}

bool LocalTransport::open(const SocketAddress & /*address*/, QString *error)
{
    if (m_pipe[0] >= 0)
        return true;
    if (!m_doorbell.data() && !m_doorbell.create(sizeof(Doorbell), error))
        return false;
    if (::pipe2(m_pipe, O_NONBLOCK | O_CLOEXEC) == 0)
        return true;
    *error = QStringLiteral("no pipe for local nodes: %1").arg(systemErrorText());
    return false;
}

bool LocalTransport::owns(const HubPeer &peer) const noexcept
{
    return dynamic_cast<const Peer *>(&peer) != nullptr;
}

void LocalTransport::attach(HubPeer *peer) noexcept
{
    auto *own = static_cast<Peer *>(peer);
    m_peers.push_back(own);
    m_next = m_peers.size();
}

void LocalTransport::detach(HubPeer *peer) noexcept
{
    m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    m_next = m_peers.size();
}

void LocalTransport::addDescriptors(std::vector<pollfd> *descriptors) const
{
    descriptors->push_back({m_pipe[0], POLLIN, 0});
}

bool LocalTransport::send(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    auto *to = static_cast<Peer *>(peer);
    to->isToBeWoken = to->channel->inputs.push(frame, size);
    m_areSomeToWake = m_areSomeToWake || to->isToBeWoken;
    to->sendFailures += to->isToBeWoken ? 0 : 1;
    return to->isToBeWoken;
}

void LocalTransport::flush() noexcept
{
    if (!std::exchange(m_areSomeToWake, false))
        return;
    const auto isAwaited = [](const Peer *peer) { return peer->isToBeWoken && !peer->isListener; };
    const auto awaited = std::count_if(m_peers.begin(), m_peers.end(), isAwaited);
    doorbell()->want(m_rung + std::uint32_t(std::max<std::ptrdiff_t>(awaited, 1)));  // before the first can answer
    for (Peer *peer : m_peers) {
        if (peer->isToBeWoken)
            peer->channel->inputs.wake();
        peer->isToBeWoken = false;
    }
}

bool LocalTransport::waitAlone(std::int64_t timeout, bool *arrived) noexcept
{
    if (timeout > 0 && !m_isFlooded)
        doorbell()->sleep(timeout);
    *arrived = look();
    return true;
}

bool LocalTransport::beginWait(bool isToSleep) noexcept
{
    return !m_isFlooded && (!isToSleep || doorbell()->beginPoll());
}

bool LocalTransport::endWait(pollfd *polled) noexcept
{
    if (polled->revents != 0) {
        char rings[64];
        while (::read(m_pipe[0], rings, sizeof rings) == ssize_t(sizeof rings)) {}
    }
    return look();
}

/// Begins a turn of looking at all peers. \return whether there may be frames
bool LocalTransport::look() noexcept
{
    doorbell()->endPoll();
    const std::uint32_t rung = doorbell()->count();
    const bool wasFlooded = std::exchange(m_isFlooded, false);
    const bool arrived = rung != m_rung || wasFlooded;
    m_rung = rung;
    doorbell()->want(rung + 1);
    m_next = m_read = 0;
    return arrived;
}

bool LocalTransport::next(HubFrame *frame) noexcept
{
    for (; m_next < m_peers.size(); ++m_next, m_read = 0) {
        if (m_read >= FramesPerWait) {
            m_isFlooded = true;
            ++arrivals().floods;
            continue;
        }
        const std::size_t size = m_peers[m_next]->channel->outputs.pop(m_frame.data(), m_frame.size());
        if (size > 0) {
            ++m_read;
            *frame = {m_peers[m_next], m_frame.data(), size};
            return true;
        }
    }
    return false;
}

}  // namespace qplc

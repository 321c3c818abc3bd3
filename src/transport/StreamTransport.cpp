// SPDX-License-Identifier: Apache-2.0
#include "StreamTransport.h"

#include "StreamSender.h"

#include <algorithm>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

class StreamTransport::Peer final : public HubPeer
{
public:
    Peer(int socket, const FrameCutter &frameCutter, std::size_t largestFrame)
        : descriptor(socket)
        , cutter(frameCutter)
        , received(4 * largestFrame)
        , sender(largestFrame)
    {
        const int on = 1;
        ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    }
    ~Peer() override { ::close(descriptor); }
    bool isClosed() const override { return closed; }
    bool hasRest() const override { return sender.hasRest(); }

    const int descriptor;
    FrameCutter cutter;
    FrameBuffer received;
    StreamSender sender;
    bool closed = false;
};

StreamTransport::StreamTransport()
{
    m_peers.reserve(MaximumPeers);
}

StreamTransport::~StreamTransport() = default;

std::unique_ptr<HubPeer> StreamTransport::peer(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
{
    return std::make_unique<Peer>(descriptor, cutter, largestFrame);
}

bool StreamTransport::owns(const HubPeer &peer) const noexcept
{
    return dynamic_cast<const Peer *>(&peer) != nullptr;
}

void StreamTransport::attach(HubPeer *peer) noexcept
{
    auto *own = static_cast<Peer *>(peer);
    m_peers.push_back(own);
    m_next = m_peers.size();
}

void StreamTransport::detach(HubPeer *peer) noexcept
{
    m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    m_next = m_peers.size();
}

void StreamTransport::addDescriptors(std::vector<pollfd> *descriptors) const
{
    for (const Peer *peer : m_peers)
        descriptors->push_back({peer->closed ? -1 : peer->descriptor, POLLIN, 0});
}

bool StreamTransport::send(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    auto *to = static_cast<Peer *>(peer);
    if (!to->closed && to->sender.send(to->descriptor, frame, size, MSG_DONTWAIT))
        return true;
    ++to->sendFailures;
    return false;
}

void StreamTransport::sendRest(HubPeer *peer) noexcept
{
    auto *to = static_cast<Peer *>(peer);
    if (!to->closed)
        to->sender.sendRest(to->descriptor, MSG_DONTWAIT);
}

bool StreamTransport::endWait(pollfd *polled) noexcept
{
    m_polled = polled;
    const pollfd *end = polled + m_peers.size();
    const bool arrived
        = std::any_of(static_cast<const pollfd *>(polled), end, [](const pollfd &each) { return each.revents != 0; });
    m_next = arrived ? 0 : m_peers.size();
    return arrived;
}

bool StreamTransport::next(HubFrame *frame) noexcept
{
    for (; m_next < m_peers.size(); ++m_next) {
        Peer &peer = *m_peers[m_next];
        pollfd &polled = m_polled[m_next];
        if (nextOf(peer, &polled, frame))
            return true;
        if (peer.closed && polled.fd >= 0) {
            ::shutdown(polled.fd, SHUT_RDWR);  // the other end shall know
            polled.fd = -1;                    // poll() ignores it from now on
        }
    }
    return false;
}

bool StreamTransport::nextOf(Peer &peer, pollfd *polled, HubFrame *frame) noexcept
{
    for (;;) {
        const FrameBuffer::Result result = peer.received.next(peer.cutter, &frame->bytes, &frame->size);
        frame->peer = &peer;
        if (result == FrameBuffer::Frame)
            return true;
        peer.closed = peer.closed || result == FrameBuffer::Garbage;
        if (polled->revents == 0 || peer.closed)
            return false;
        polled->revents = 0;  // one recv() for each event; what remains wakes the next wait
        peer.received.compact();
        const ssize_t count = ::recv(peer.descriptor, peer.received.space(), peer.received.spaceSize(), MSG_DONTWAIT);
        if (count > 0)
            peer.received.filled(std::size_t(count));
        else if (count == 0 || (errno != EAGAIN && errno != EINTR))
            peer.closed = true;
    }
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

std::unique_ptr<HubPeer> HubPeer::udp(const SocketAddress &address)
{
    std::unique_ptr<HubPeer> peer(new HubPeer);
    peer->m_address = address;
    return peer;
}

std::unique_ptr<HubPeer> HubPeer::tcp(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
{
    std::unique_ptr<HubPeer> peer(new HubPeer);
    const int on = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    peer->m_descriptor = descriptor;
    peer->m_cutter = cutter;
    peer->m_received = std::make_unique<FrameBuffer>(4 * largestFrame);
    peer->m_sender.emplace(largestFrame);
    return peer;
}

std::unique_ptr<HubPeer> HubPeer::local(std::unique_ptr<SharedMemory> memory)
{
    std::unique_ptr<HubPeer> peer(new HubPeer);
    peer->m_memory = std::move(memory);
    return peer;
}

HubPeer::~HubPeer()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

bool HubPeer::sendStream(const char *frame, std::size_t size) noexcept
{
    if (!m_closed && m_sender->send(m_descriptor, frame, size, MSG_DONTWAIT))
        return true;
    ++m_sendFailures;
    return false;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "UdpTransport.h"

#include <QtCore/qendian.h>
#include <QtNetwork/QUdpSocket>

#include <algorithm>
#include <cerrno>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

// The kernel rounds the time limit of a receiving socket up to whole ticks of its clock, of up to
// 10 ms: too coarse for the end of a cycle, good enough for long waits.
constexpr std::int64_t CoarseWait = 4'000'000;  // [ns]
constexpr std::int64_t LongWait = 20'000'000;   // [ns]

}  // namespace

class UdpTransport::Peer final : public HubPeer
{
public:
    explicit Peer(const SocketAddress &to)
        : address(to)
    {
    }
    bool losesFrames() const override { return true; }

    SocketAddress address;
};

struct UdpTransport::Messages
{
    std::array<mmsghdr, MaximumPeers> outgoing{};
    std::array<iovec, MaximumPeers> outgoingBytes{};
    std::array<Peer *, MaximumPeers> outgoingPeer{};
    std::array<mmsghdr, Batch> incoming{};
    std::array<iovec, Batch> incomingBytes{};
    std::array<SocketAddress, Batch> senders{};
    std::array<std::array<char, LargestDatagram>, Batch> datagrams{};
};

UdpTransport::UdpTransport()
    : m_messages(std::make_unique<Messages>())
{
    m_peers.reserve(MaximumPeers);
    for (std::size_t i = 0; i < Batch; ++i) {
        m_messages->incomingBytes[i] = {m_messages->datagrams[i].data(), LargestDatagram};
        msghdr &header = m_messages->incoming[i].msg_hdr;
        header.msg_iov = &m_messages->incomingBytes[i];
        header.msg_iovlen = 1;
        header.msg_name = m_messages->senders[i].data();
    }
}

UdpTransport::~UdpTransport()
{
    close();
}

std::unique_ptr<HubPeer> UdpTransport::peer(const SocketAddress &address)
{
    return std::make_unique<Peer>(address);
}

// ---- the socket ----

bool UdpTransport::open(const SocketAddress &address, QString *error)
{
    m_socket = ::socket(address.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const timeval longestReceive{0, suseconds_t(CoarseWait / 1000)};
    ::setsockopt(m_socket, SOL_SOCKET, SO_RCVTIMEO, &longestReceive, sizeof longestReceive);
    m_isIpv6 = address.family() == AF_INET6;
    const int off = 0;
    if (m_isIpv6)
        ::setsockopt(m_socket, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
    if (m_socket >= 0 && ::bind(m_socket, address.data(), address.length) == 0)
        return true;
    *error = QStringLiteral("cannot use UDP port %1: %2").arg(address.toString(), systemErrorText());
    return false;  // the hub closes all its transports
}

void UdpTransport::close()
{
    if (m_socket >= 0)
        ::close(m_socket);
    m_socket = -1;
    m_outgoing = m_arrived = m_taken = 0;
    m_hasMore = false;
}

bool UdpTransport::openGroup(const QHostAddress &address, const QHostAddress &group, QString *error)
{
    m_group = SocketAddress();
    if (group.isNull())
        return true;
    if (!group.isMulticast() || group.protocol() != QAbstractSocket::IPv4Protocol) {
        *error = QStringLiteral("%1 is not an IPv4 multicast group; use one of 239.0.0.0 ... 239.255.255.255")
                     .arg(group.toString());
        return false;
    }
    QUdpSocket finder;  // a port of its own: nodes of this machine share it with each other, not with the server
    finder.bind(QHostAddress::AnyIPv4, 0);
    m_group = SocketAddress(group, finder.localPort());
    const in_addr interface {
        qToBigEndian(address.toIPv4Address())
    };
    const unsigned char hops = 1;
    if (!m_isIpv6 && ::setsockopt(m_socket, IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface) == 0
        && ::setsockopt(m_socket, IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops) == 0)
        return true;
    *error = m_isIpv6 ? QStringLiteral("multicast needs IPv4: listen on an IPv4 address")
                      : QStringLiteral("cannot send multicast from %1: %2").arg(address.toString(), systemErrorText());
    return false;
}

std::uint64_t UdpTransport::unread() const
{
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof memory;
    return ::getsockopt(m_socket, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 ? memory[SK_MEMINFO_DROPS] : 0;
}

void UdpTransport::addDescriptors(std::vector<pollfd> *descriptors) const
{
    descriptors->push_back({m_socket, POLLIN, 0});
}

// ---- peers ----

bool UdpTransport::owns(const HubPeer &peer) const noexcept
{
    return dynamic_cast<const Peer *>(&peer) != nullptr;
}

void UdpTransport::attach(HubPeer *peer) noexcept
{
    auto *own = static_cast<Peer *>(peer);
    if (m_isIpv6)
        own->address = own->address.mappedToIpv6();
    m_peers.push_back(own);
    rebuild();
}

void UdpTransport::detach(HubPeer *peer) noexcept
{
    m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    rebuild();
}

std::size_t UdpTransport::placeOf(std::uint64_t key) noexcept
{
    return std::size_t(key * 0x9E3779B97F4A7C15u >> 32) % TableSize;
}

void UdpTransport::rebuild() noexcept
{
    m_table.fill(nullptr);
    for (Peer *peer : m_peers) {
        std::size_t place = placeOf(peer->address.key());
        while (m_table[place])
            place = (place + 1) % TableSize;
        m_table[place] = peer;
    }
}

UdpTransport::Peer *UdpTransport::find(const SocketAddress &address) noexcept
{
    std::size_t place = placeOf(address.key());
    while (m_table[place] && !(m_table[place]->address == address))
        place = (place + 1) % TableSize;
    return m_table[place];
}

// ---- sending ----

bool UdpTransport::send(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    if (m_outgoing == MaximumPeers)
        flush();
    auto *to = static_cast<Peer *>(peer);
    m_messages->outgoingBytes[m_outgoing] = {const_cast<char *>(frame), size};
    m_messages->outgoingPeer[m_outgoing] = to;
    msghdr &header = m_messages->outgoing[m_outgoing].msg_hdr;
    header = {};
    header.msg_name = to->address.data();
    header.msg_namelen = to->address.length;
    header.msg_iov = &m_messages->outgoingBytes[m_outgoing];
    header.msg_iovlen = 1;
    ++m_outgoing;
    return true;
}

void UdpTransport::flush() noexcept
{
    std::size_t done = 0;
    while (done < m_outgoing) {
        const int sent = ::sendmmsg(m_socket, m_messages->outgoing.data() + done, unsigned(m_outgoing - done),
                                    MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent > 0) {
            done += std::size_t(sent);
            continue;
        }
        if (errno == EINTR)
            continue;
        ++m_messages->outgoingPeer[done]->sendFailures;  // the first one was refused: the others may still go
        ++done;
    }
    m_outgoing = 0;
}

// ---- receiving ----

/// One system call instead of two, where the end of the wait need not be exact.
bool UdpTransport::waitAlone(std::int64_t timeout, bool *arrived) noexcept
{
    if (m_socket < 0 || timeout < LongWait)
        return false;
    m_read = 0;
    m_hasMore = receive(MSG_WAITFORONE) == int(Batch);
    *arrived = m_arrived > 0;
    return true;
}

bool UdpTransport::endWait(pollfd *polled) noexcept
{
    m_read = m_arrived = m_taken = 0;
    m_hasMore = polled->revents != 0;
    return m_hasMore;
}

int UdpTransport::receive(int flags) noexcept
{
    for (std::size_t i = 0; i < Batch; ++i)
        m_messages->incoming[i].msg_hdr.msg_namelen = sizeof(sockaddr_storage);
    const int count = ::recvmmsg(m_socket, m_messages->incoming.data(), Batch, flags, nullptr);
    m_taken = 0;
    m_arrived = count > 0 ? std::size_t(count) : 0;
    m_read += m_arrived;
    return count;
}

/// Takes the next datagrams from the kernel. \return false when there are none, or none in this
/// turn
bool UdpTransport::readMore() noexcept
{
    if (!m_hasMore)
        return false;
    if (m_read >= FramesPerWait) {
        m_hasMore = false;
        ++arrivals().floods;
        return false;
    }
    m_hasMore = receive(MSG_DONTWAIT) == int(Batch);
    return m_arrived > 0;
}

bool UdpTransport::next(HubFrame *frame) noexcept
{
    while (m_taken < m_arrived || readMore()) {
        const std::size_t i = m_taken++;
        if (Peer *peer = find(m_messages->senders[i])) {
            *frame = {peer, m_messages->datagrams[i].data(), m_messages->incoming[i].msg_len};
            return true;
        }
        ++arrivals().strangers;
    }
    return false;
}

}  // namespace qplc

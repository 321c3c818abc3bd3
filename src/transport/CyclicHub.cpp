// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"

#include "realtime/TimeSource.h"

#include <QtCore/qendian.h>
#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace qplc {

namespace {

// The kernel rounds the time limit of a receiving socket up to whole ticks of its clock, of up to 10 ms: too coarse for the end of a cycle, good enough for long waits.
constexpr std::int64_t CoarseWait = 4'000'000;  // [ns]
constexpr std::int64_t LongWait = 20'000'000;   // [ns]

}  // namespace

struct CyclicHub::Messages
{
    std::array<mmsghdr, MaximumPeers> outgoing{};
    std::array<iovec, MaximumPeers> outgoingBytes{};
    std::array<HubPeer *, MaximumPeers> outgoingPeer{};
    std::array<mmsghdr, Batch> incoming{};
    std::array<iovec, Batch> incomingBytes{};
    std::array<SocketAddress, Batch> senders{};
    std::array<std::array<char, LargestDatagram>, Batch> datagrams{};
};

CyclicHub::CyclicHub()
    : m_messages(std::make_unique<Messages>())
{
    m_peers.reserve(MaximumPeers);
    m_polled.reserve(MaximumPeers + FirstStream);
    m_streams.reserve(MaximumPeers);
    m_locals.reserve(MaximumPeers);
    for (std::size_t i = 0; i < Batch; ++i) {
        m_messages->incomingBytes[i] = {m_messages->datagrams[i].data(), LargestDatagram};
        msghdr &header = m_messages->incoming[i].msg_hdr;
        header.msg_iov = &m_messages->incomingBytes[i];
        header.msg_iovlen = 1;
        header.msg_name = m_messages->senders[i].data();
    }
    rebuild();
}

CyclicHub::~CyclicHub()
{
    for (const int descriptor : {m_udp, m_pipe[0], m_pipe[1]}) {  // not more: the peers may be gone already
        if (descriptor >= 0)
            ::close(descriptor);
    }
}

bool CyclicHub::open(const SocketAddress &address, QString *error)
{
    close();
    m_udp = ::socket(address.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const timeval longestReceive{0, suseconds_t(CoarseWait / 1000)};
    ::setsockopt(m_udp, SOL_SOCKET, SO_RCVTIMEO, &longestReceive, sizeof longestReceive);
    m_isIpv6 = address.family() == AF_INET6;
    const int off = 0;
    if (m_isIpv6)
        ::setsockopt(m_udp, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
    if (m_udp < 0 || ::bind(m_udp, address.data(), address.length) < 0) {
        *error = QStringLiteral("cannot use UDP port %1: %2").arg(address.toString(), systemErrorText());
        close();
        return false;
    }
    rebuild();
    return true;
}

void CyclicHub::close()
{
    if (m_udp >= 0)
        ::close(m_udp);
    m_udp = -1;
    m_outgoing = m_arrived = m_taken = 0;
    rebuild();
}

bool CyclicHub::openMulticast(const QHostAddress &address, QString *error)
{
    const in_addr interface {
        qToBigEndian(address.toIPv4Address())
    };
    const unsigned char hops = 1;
    if (!m_isIpv6 && ::setsockopt(m_udp, IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface) == 0
        && ::setsockopt(m_udp, IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops) == 0)
        return true;
    *error = m_isIpv6 ? QStringLiteral("multicast needs IPv4: listen on an IPv4 address")
                      : QStringLiteral("no multicast by way of %1: %2").arg(address.toString(), systemErrorText());
    return false;
}

bool CyclicHub::openLocal(QString *error)
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

CyclicHub::LocalPaths CyclicHub::localPaths() const
{
    return {m_doorbell.path(), QStringLiteral("/proc/%1/fd/%2").arg(::getpid()).arg(m_pipe[1])};
}

void CyclicHub::setFaults(const std::optional<FaultPlan> &plan, TimeSource &time)
{
    m_faults = plan ? std::make_unique<HubFaults>(*plan, time) : nullptr;
}

void CyclicHub::exposeToFaults(HubPeer &peer, std::uint64_t stream) const
{
    if (m_faults)
        peer.m_faults = std::make_unique<PeerFaults>(m_faults->plan(), stream);
}

std::uint64_t CyclicHub::unread() const
{
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof memory;
    return ::getsockopt(m_udp, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 ? memory[SK_MEMINFO_DROPS] : 0;
}

void CyclicHub::attach(HubPeer *peer) noexcept
{
    if (m_peers.size() < MaximumPeers) {
        if (m_isIpv6 && peer->isUdp())
            peer->m_address = peer->m_address.mappedToIpv6();
        m_peers.push_back(peer);
        rebuild();
    }
}

void CyclicHub::detach(HubPeer *peer) noexcept
{
    flush();
    if (m_faults)
        m_faults->forget(peer);
    m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    rebuild();
}

void CyclicHub::rebuild() noexcept
{
    m_table.fill(nullptr);
    m_streams.clear();
    m_locals.clear();
    m_udpPeers = 0;
    m_polled.clear();
    m_polled.push_back({m_udp, POLLIN, 0});
    m_polled.push_back({m_pipe[0], POLLIN, 0});
    m_polled.push_back({-1, POLLIN, 0});
    for (HubPeer *peer : m_peers) {
        if (peer->isLocal()) {
            m_locals.push_back(peer);
            continue;
        }
        if (peer->isStream()) {
            m_streams.push_back(peer);
            m_polled.push_back({peer->m_closed ? -1 : peer->m_descriptor, POLLIN, 0});
            continue;
        }
        ++m_udpPeers;
        std::size_t place = std::size_t(peer->m_address.key() * 0x9E3779B97F4A7C15u >> 32) % TableSize;
        while (m_table[place])
            place = (place + 1) % TableSize;
        m_table[place] = peer;
    }
    m_stream = m_streams.size();
    m_local = m_locals.size();
}

HubPeer *CyclicHub::find(const SocketAddress &address) noexcept
{
    const quint64 key = address.key();
    std::size_t place = std::size_t(key * 0x9E3779B97F4A7C15u >> 32) % TableSize;
    while (m_table[place] && m_table[place]->m_address.key() != key)
        place = (place + 1) % TableSize;
    return m_table[place];
}

void CyclicHub::sendRest(HubPeer *peer) noexcept
{
    if (peer->m_sender && !peer->m_closed)
        peer->m_sender->sendRest(peer->m_descriptor, MSG_DONTWAIT);
}

bool CyclicHub::send(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    // What a bad network does to a frame is no failure of sending it.
    if (peer->m_faults && !m_faults->sends(*peer->m_faults, peer, frame, size))
        return true;
    return sendNow(peer, frame, size);
}

bool CyclicHub::sendNow(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    if (peer->isStream())
        return peer->sendStream(frame, size);
    if (peer->isLocal()) {
        peer->m_toBeWoken = peer->channel()->inputs.push(frame, size);
        m_localsToWake = m_localsToWake || peer->m_toBeWoken;
        peer->m_sendFailures += peer->m_toBeWoken ? 0 : 1;
        return peer->m_toBeWoken;
    }
    if (m_outgoing == MaximumPeers)
        flushNow();
    m_messages->outgoingBytes[m_outgoing] = {const_cast<char *>(frame), size};
    m_messages->outgoingPeer[m_outgoing] = peer;
    msghdr &header = m_messages->outgoing[m_outgoing].msg_hdr;
    header = {};
    header.msg_name = peer->m_address.data();
    header.msg_namelen = peer->m_address.length;
    header.msg_iov = &m_messages->outgoingBytes[m_outgoing];
    header.msg_iovlen = 1;
    ++m_outgoing;
    return true;
}

void CyclicHub::flush() noexcept
{
    flushNow();
    if (m_faults)
        sendDelayed();
}

/// What was kept under way so far.
void CyclicHub::sendDelayed() noexcept
{
    for (DelayLine::Frame frame; m_faults->takeSending(&frame);) {
        sendNow(static_cast<HubPeer *>(frame.owner), frame.bytes, frame.size);
        flushNow();  // the bytes stay until the next one is taken
    }
}

void CyclicHub::flushNow() noexcept
{
    std::size_t done = 0;
    while (done < m_outgoing) {
        const int sent = ::sendmmsg(m_udp, m_messages->outgoing.data() + done, unsigned(m_outgoing - done),
                                    MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent > 0) {
            done += std::size_t(sent);
            continue;
        }
        if (errno == EINTR)
            continue;
        ++m_messages->outgoingPeer[done]->m_sendFailures;  // the first one was refused: the others may still go
        ++done;
    }
    m_outgoing = 0;
    if (m_localsToWake)
        wakeLocals();
}

void CyclicHub::wakeLocals() noexcept
{
    m_localsToWake = false;
    const auto isAwaited = [](const HubPeer *peer) { return peer->m_toBeWoken && !peer->isListener; };
    const auto awaited = std::count_if(m_locals.begin(), m_locals.end(), isAwaited);
    doorbell()->want(m_rung + std::uint32_t(std::max<std::ptrdiff_t>(awaited, 1)));  // before the first can answer
    for (HubPeer *peer : m_locals) {
        if (peer->m_toBeWoken)
            peer->channel()->inputs.wake();
        peer->m_toBeWoken = false;
    }
}

// ---- receiving ----

bool CyclicHub::wait(std::int64_t timeout, int alarm) noexcept
{
    m_read = 0;
    if (!m_faults)
        return waitForArrivals(timeout, alarm);
    sendDelayed();
    const std::int64_t left = m_faults->timeLeft(timeout);
    const bool arrived = waitForArrivals(left, left < timeout ? -1 : alarm);
    sendDelayed();
    return m_faults->hasArrived() || arrived;
}

bool CyclicHub::waitForArrivals(std::int64_t timeout, int alarm) noexcept
{
    if (m_locals.empty())
        return waitForDescriptors(timeout, alarm);
    const bool isFlooded = std::exchange(m_isFlooded, false);
    timeout = isFlooded ? 0 : timeout;
    const bool hasOthers = m_udpPeers + m_streams.size() > 0;
    bool arrived = false;
    if (timeout > 0 && (hasOthers || alarm >= 0) && doorbell()->beginPoll())
        arrived = pollDescriptors(timeout, alarm);
    else if (hasOthers)
        arrived = pollDescriptors(0, -1);
    else if (timeout > 0 && alarm < 0)
        doorbell()->sleep(timeout);
    doorbell()->endPoll();
    const std::uint32_t rung = doorbell()->count();
    arrived = arrived || rung != m_rung || isFlooded;
    m_rung = rung;
    doorbell()->want(rung + 1);
    m_local = m_readOfLocal = 0;
    return arrived;
}

bool CyclicHub::waitForDescriptors(std::int64_t timeout, int alarm) noexcept
{
    if (m_streams.empty() && m_udp >= 0 && timeout >= LongWait && alarm < 0)
        return waitInReceive();
    return pollDescriptors(timeout, alarm);
}

/// One system call instead of two, where only datagrams can come and the end of the wait need not be exact.
bool CyclicHub::waitInReceive() noexcept
{
    m_moreDatagrams = receiveDatagrams(MSG_WAITFORONE) == int(Batch);
    return m_arrived > 0;
}

bool CyclicHub::pollDescriptors(std::int64_t timeout, int alarm) noexcept
{
    const timespec limit = timeSpec(timeout);
    m_polled[Alarm].fd = alarm;
    m_polled[Alarm].revents = 0;
    const int ready = ::ppoll(m_polled.data(), m_polled.size(), alarm < 0 ? &limit : nullptr, nullptr);
    m_moreDatagrams = ready > 0 && m_polled[Datagrams].revents != 0;
    if (ready > 0 && m_polled[Pipe].revents != 0) {
        char rings[64];
        while (::read(m_pipe[0], rings, sizeof rings) == ssize_t(sizeof rings)) {}
    }
    m_arrived = m_taken = 0;
    m_stream = ready > 0 ? 0 : m_streams.size();
    return ready > (m_polled[Alarm].revents != 0 ? 1 : 0);
}

bool CyclicHub::next(Incoming *incoming) noexcept
{
    if (!m_faults)
        return nextArrived(incoming);
    while (nextArrived(incoming)) {
        HubPeer *peer = incoming->peer;
        if (!peer->m_faults || m_faults->receives(*peer->m_faults, peer, incoming->frame, incoming->size))
            return true;
    }
    DelayLine::Frame frame;
    if (!m_faults->takeReceived(&frame))
        return false;
    *incoming = {static_cast<HubPeer *>(frame.owner), frame.bytes, frame.size};
    return true;
}

bool CyclicHub::nextArrived(Incoming *incoming) noexcept
{
    return nextDatagram(incoming) || nextFromStream(incoming) || nextLocal(incoming);
}

int CyclicHub::receiveDatagrams(int flags) noexcept
{
    for (std::size_t i = 0; i < Batch; ++i)
        m_messages->incoming[i].msg_hdr.msg_namelen = sizeof(sockaddr_storage);
    const int count = ::recvmmsg(m_udp, m_messages->incoming.data(), Batch, flags, nullptr);
    m_taken = 0;
    m_arrived = count > 0 ? std::size_t(count) : 0;
    m_read += m_arrived;
    return count;
}

bool CyclicHub::nextDatagram(Incoming *incoming) noexcept
{
    for (;;) {
        if (m_taken == m_arrived) {
            if (!m_moreDatagrams)
                return false;
            if (m_read >= FramesPerWait) {
                m_moreDatagrams = false;
                ++m_floods;
                return false;
            }
            m_moreDatagrams = receiveDatagrams(MSG_DONTWAIT) == int(Batch);
            if (m_arrived == 0)
                return false;
        }
        const std::size_t i = m_taken++;
        incoming->peer = find(m_messages->senders[i]);
        incoming->frame = m_messages->datagrams[i].data();
        incoming->size = m_messages->incoming[i].msg_len;
        if (incoming->peer)
            return true;
        ++m_strangers;
    }
}

bool CyclicHub::nextLocal(Incoming *incoming) noexcept
{
    for (; m_local < m_locals.size(); ++m_local, m_readOfLocal = 0) {
        if (m_readOfLocal >= FramesPerWait) {
            m_isFlooded = true;
            ++m_floods;
            continue;
        }
        const std::size_t size = m_locals[m_local]->channel()->outputs.pop(m_localFrame.data(), m_localFrame.size());
        if (size > 0) {
            ++m_readOfLocal;
            *incoming = {m_locals[m_local], m_localFrame.data(), size};
            return true;
        }
    }
    return false;
}

bool CyclicHub::nextFromStream(Incoming *incoming) noexcept
{
    for (; m_stream < m_streams.size(); ++m_stream) {
        pollfd &polled = m_polled[m_stream + FirstStream];
        HubPeer *peer = m_streams[m_stream];
        for (;;) {
            const FrameBuffer::Result result
                = peer->m_received->next(peer->m_cutter, &incoming->frame, &incoming->size);
            if (result == FrameBuffer::Frame) {
                incoming->peer = peer;
                return true;
            }
            peer->m_closed = peer->m_closed || result == FrameBuffer::Garbage;
            if (polled.revents == 0 || peer->m_closed)
                break;
            polled.revents = 0;  // one recv() for each event; what remains wakes the next wait()
            peer->m_received->compact();
            const ssize_t count
                = ::recv(peer->m_descriptor, peer->m_received->space(), peer->m_received->spaceSize(), MSG_DONTWAIT);
            if (count > 0)
                peer->m_received->filled(std::size_t(count));
            else if (count == 0 || (errno != EAGAIN && errno != EINTR))
                peer->m_closed = true;
        }
        if (peer->m_closed && polled.fd >= 0) {
            ::shutdown(polled.fd, SHUT_RDWR);  // the other end shall know
            polled.fd = -1;                    // poll() ignores it from now on
        }
    }
    return false;
}

}  // namespace qplc

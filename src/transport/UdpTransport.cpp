// SPDX-License-Identifier: Apache-2.0
#include "UdpTransport.h"

#include "DatagramFilter.h"

#include <QtCore/QSocketNotifier>
#include <QtCore/qendian.h>
#include <QtNetwork/QUdpSocket>

#include <algorithm>
#include <cerrno>
#include <linux/sock_diag.h>
#include <mutex>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

// The kernel rounds the time limit of a receiving socket up to whole ticks of its clock, of up to
// 10 ms: too coarse for the end of a cycle, good enough for long waits.
constexpr std::int64_t CoarseWait = 4'000'000;  // [ns]
constexpr std::int64_t LongWait = 20'000'000;   // [ns]

// Room for answers that nobody has read yet, in the kernel.
constexpr std::size_t CyclesOfRoom = 8;
constexpr std::size_t LeastFrames = 128;
constexpr std::size_t MemoryOfFrame = 1280;  // [byte] the kernel takes it twice, for its own data

/// Datagrams that the kernel has dropped before \a socket could read them.
std::uint64_t dropsOf(int socket)
{
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof memory;
    return ::getsockopt(socket, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 ? memory[SK_MEMINFO_DROPS] : 0;
}

/// Not bound yet; of IPv6, one that also speaks IPv4. -1: there is none.
int newSocket(int family)
{
    const int off = 0;
    const int made = ::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (family == AF_INET6)
        ::setsockopt(made, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
    return made;
}

/// Allows other sockets of this user on the same port.
bool sharePort(int socket)
{
    const int on = 1;
    return ::setsockopt(socket, SOL_SOCKET, SO_REUSEPORT, &on, sizeof on) == 0;
}

}  // namespace

/// The UDP port of a master: a socket for its peers, and one for strangers, whose datagrams the
/// kernel counts and drops.
class UdpTransport::Port
{
public:
    struct Guest
    {
        SocketAddress address;
        std::size_t frames = 0;  // that it sends in a cycle
    };

    ~Port() { close(); }
    bool open(const SocketAddress &address);
    void close();
    /// By the owners of peers, one of whom may be a cycle thread that frees a node at last.
    void add(const Guest &guest);
    void remove(const Guest &guest);

    int ofPeers() const { return m_ofPeers; }
    /// Datagrams of strangers so far.
    std::uint64_t keptOff() const
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return m_keptOffBefore + dropsOf(m_ofStrangers);
    }

private:
    bool join(const SocketAddress &address);
    void tellKernel() const;

    mutable std::mutex m_mutex;
    int m_ofPeers = -1;
    int m_ofStrangers = -1;
    std::uint64_t m_keptOffBefore = 0;  // before the port was closed last
    std::vector<Guest> m_guests;
};

class UdpTransport::Peer final : public HubPeer
{
public:
    Peer(const std::shared_ptr<Port> &port, const Port::Guest &guest)
        : address(guest.address)
        , m_port(port)
        , m_guest(guest)
    {
        m_port->add(m_guest);
    }
    ~Peer() override { m_port->remove(m_guest); }
    bool losesFrames() const override { return true; }

    SocketAddress address;

private:
    const std::shared_ptr<Port> m_port;
    const Port::Guest m_guest;
};

/// A third socket on the port, for a node that is no peer yet. It is connected, so the kernel gives
/// it the datagrams of that address, and of no other one.
class UdpTransport::ProbePort final : public ProbeAnswers
{
public:
    ProbePort(const SocketAddress &own, const SocketAddress &node, const ProbeNumbers &numbers)
        : ProbeAnswers(numbers)
        , m_socket(newSocket(own.family()))
    {
        const SocketAddress to = own.family() == AF_INET6 ? node.mappedToIpv6() : node;
        m_isOpen = sharePort(m_socket) && ::bind(m_socket, own.data(), own.length) == 0
            && ::connect(m_socket, to.data(), to.length) == 0;
        if (!m_isOpen)
            return;
        m_arrival = std::make_unique<QSocketNotifier>(m_socket, QSocketNotifier::Read);
        QObject::connect(m_arrival.get(), &QSocketNotifier::activated, m_arrival.get(), [this] { read(); });
    }
    ~ProbePort() override
    {
        m_arrival.reset();
        if (m_socket >= 0)
            ::close(m_socket);
    }
    bool isOpen() const { return m_isOpen; }

private:
    void read()
    {
        std::array<char, LargestDatagram> datagram;
        const ssize_t size = ::recv(m_socket, datagram.data(), datagram.size(), MSG_DONTWAIT);
        if (size > 0 && answer(datagram.data(), std::size_t(size)))
            ::send(m_socket, datagram.data(), std::size_t(size), MSG_DONTWAIT | MSG_NOSIGNAL);
        m_arrival->setEnabled(++m_read < MostRead);
    }

    static constexpr int MostRead = 1000;  // datagrams, with those that somebody sends in the name of the node

    const int m_socket;
    bool m_isOpen = false;
    int m_read = 0;
    std::unique_ptr<QSocketNotifier> m_arrival;
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
    : m_port(std::make_shared<Port>())
    , m_messages(std::make_unique<Messages>())
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

std::unique_ptr<HubPeer> UdpTransport::peer(const SocketAddress &address, const FrameVolume &answers)
{
    return std::make_unique<Peer>(m_port, Port::Guest{address, answers.frames});
}

std::unique_ptr<ProbeAnswers> UdpTransport::answerProbe(const SocketAddress &address, const ProbeNumbers &numbers) const
{
    SocketAddress own;
    own.length = sizeof own.storage;
    if (::getsockname(m_socket, own.data(), &own.length) != 0)
        return nullptr;
    auto port = std::make_unique<ProbePort>(own, address, numbers);
    return port->isOpen() ? std::move(port) : nullptr;
}

// ---- the port ----

bool UdpTransport::Port::open(const SocketAddress &address)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (int *socket : {&m_ofPeers, &m_ofStrangers})
        *socket = newSocket(address.family());
    const timeval longestReceive{0, suseconds_t(CoarseWait / 1000)};
    ::setsockopt(m_ofPeers, SOL_SOCKET, SO_RCVTIMEO, &longestReceive, sizeof longestReceive);
    if (m_ofPeers < 0 || ::bind(m_ofPeers, address.data(), address.length) != 0 || !join(address))
        return false;
    tellKernel();
    return true;
}

/// Binds the second socket to the port of the first one. Nobody shares the port before: that it is
/// free is known then.
bool UdpTransport::Port::join(const SocketAddress &address)
{
    SocketAddress bound = address;
    ::getsockname(m_ofPeers, bound.data(), &bound.length);
    sock_filter dropAll{BPF_RET | BPF_K, 0, 0, 0};
    const sock_fprog program{1, &dropAll};
    return sharePort(m_ofPeers) && sharePort(m_ofStrangers)
        && ::setsockopt(m_ofStrangers, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0
        && ::bind(m_ofStrangers, bound.data(), bound.length) == 0;
}

void UdpTransport::Port::close()
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_keptOffBefore += dropsOf(m_ofStrangers);
    for (int *socket : {&m_ofPeers, &m_ofStrangers}) {
        if (*socket >= 0)
            ::close(*socket);
        *socket = -1;
    }
}

void UdpTransport::Port::add(const Guest &guest)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_guests.push_back(guest);
    tellKernel();
}

void UdpTransport::Port::remove(const Guest &guest)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto isIt = [&](const Guest &other) { return other.address == guest.address; };
    m_guests.erase(std::find_if(m_guests.begin(), m_guests.end(), isIt));
    tellKernel();
}

/// Who is a peer, and how much they send: answers of some cycles have room, should nobody read
/// them for a while.
void UdpTransport::Port::tellKernel() const
{
    if (m_ofPeers < 0)
        return;
    std::vector<SocketAddress> addresses;
    std::size_t frames = 0;
    for (const Guest &guest : m_guests) {
        addresses.push_back(guest.address);
        frames += guest.frames;
    }
    using namespace datagramFilter;
    for (Program program : {byAddress(addresses), byPort(addresses)}) {
        const sock_fprog given{std::uint16_t(program.size()), program.data()};
        if (program.size() <= BPF_MAXINSNS
            && ::setsockopt(m_ofPeers, SOL_SOCKET, SO_ATTACH_REUSEPORT_CBPF, &given, sizeof given) == 0)
            break;
    }
    const int room = int(std::max(LeastFrames, frames * CyclesOfRoom) * MemoryOfFrame);
    if (::setsockopt(m_ofPeers, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room) != 0)
        ::setsockopt(m_ofPeers, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);  // as much as net.core.rmem_max allows
}

bool UdpTransport::open(const SocketAddress &address, QString *error)
{
    m_isIpv6 = address.family() == AF_INET6;
    const bool isOpen = m_port->open(address);
    m_socket = m_port->ofPeers();
    if (isOpen)
        return true;
    *error = QStringLiteral("cannot use UDP port %1: %2").arg(address.toString(), systemErrorText());
    return false;  // the hub closes all its transports
}

void UdpTransport::close()
{
    m_port->close();
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
    return dropsOf(m_socket);
}

std::uint64_t UdpTransport::keptOff() const
{
    return m_port->keptOff();
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

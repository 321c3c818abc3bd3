// SPDX-License-Identifier: Apache-2.0
#include "CyclicLink.h"

#include "PeerFile.h"
#include "SharedChannel.h"
#include "StreamSender.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr std::size_t LargestDatagram = 2048;  // longer than every frame: what is cut off here is none

bool isTransient(int error)
{
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

class UdpLink final : public CyclicLink
{
public:
    explicit UdpLink(int descriptor)
        : CyclicLink(descriptor)
    {
    }
    ~UdpLink() override
    {
        if (m_group >= 0)
            ::close(m_group);
    }
    bool joinGroup(const SocketAddress &group, QString *error) override
    {
        SocketAddress self;
        SocketAddress master;
        self.length = master.length = sizeof self.storage;
        ::getsockname(m_descriptor, self.data(), &self.length);
        ::getpeername(m_descriptor, master.data(), &master.length);
        ip_mreq request{};
        request.imr_multiaddr = reinterpret_cast<const sockaddr_in *>(group.data())->sin_addr;
        request.imr_interface = reinterpret_cast<const sockaddr_in *>(self.data())->sin_addr;
        const int on = 1;
        m_group = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        if (self.family() == AF_INET && ::setsockopt(m_group, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0
            && ::bind(m_group, group.data(), group.length) == 0
            && ::setsockopt(m_group, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) == 0
            && ::connect(m_group, master.data(), master.length) == 0)
            return true;
        *error = QStringLiteral("cannot join the multicast group %1: %2; use udp")
                     .arg(group.toString(), systemErrorText());
        return false;
    }
    Status receive(const char **frame, std::size_t *size) noexcept override { return take(frame, size, 0); }
    Status poll(const char **frame, std::size_t *size) noexcept override { return take(frame, size, MSG_DONTWAIT); }
    bool send(const char *frame, std::size_t size) noexcept override
    {
        return ::send(m_descriptor, frame, size, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(size);
    }

private:
    Status take(const char **frame, std::size_t *size, int flags) noexcept
    {
        const ssize_t count = ::recv(m_group >= 0 ? m_group : m_descriptor, m_buffer.data(), m_buffer.size(), flags);
        if (count < 0) {
            // A master that is gone answers with "port unreachable": no reason to give the socket up.
            return isTransient(errno) || errno == ECONNREFUSED ? Nothing : Closed;
        }
        *frame = m_buffer.data();
        *size = std::size_t(count);
        return Received;
    }
    std::array<char, LargestDatagram> m_buffer;
    int m_group = -1;
};

class TcpLink final : public CyclicLink
{
public:
    TcpLink(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
        : CyclicLink(descriptor)
        , m_cutter(cutter)
        , m_buffer(4 * largestFrame)
        , m_sender(largestFrame)
    {
    }
    Status receive(const char **frame, std::size_t *size) noexcept override { return take(frame, size, 0); }
    Status poll(const char **frame, std::size_t *size) noexcept override { return take(frame, size, MSG_DONTWAIT); }
    bool send(const char *frame, std::size_t size) noexcept override
    {
        return m_sender.send(m_descriptor, frame, size, 0);
    }

private:
    Status take(const char **frame, std::size_t *size, int flags) noexcept
    {
        for (;;) {
            switch (m_buffer.next(m_cutter, frame, size)) {
            case FrameBuffer::Frame:
                return Received;
            case FrameBuffer::Garbage:
                return Closed;
            case FrameBuffer::NeedMore:
                break;
            }
            m_buffer.compact();
            m_sender.sendRest(m_descriptor, MSG_DONTWAIT);
            const ssize_t count = ::recv(m_descriptor, m_buffer.space(), m_buffer.spaceSize(), flags);
            if (count < 0)
                return isTransient(errno) ? Nothing : Closed;
            if (count == 0)
                return Closed;
            m_buffer.filled(std::size_t(count));
        }
    }
    FrameCutter m_cutter;
    FrameBuffer m_buffer;
    StreamSender m_sender;
};

class LocalLink final : public CyclicLink
{
public:
    LocalLink()
        : CyclicLink(-1)
    {
    }
    bool open(const LocalPaths &paths, uid_t owner, QString *error)
    {
        PeerFile pipe;
        if (!m_memory.open(paths.channel, QStringLiteral("memory"), sizeof(SharedChannel), owner, error)
            || !m_bell.open(paths.doorbell, QStringLiteral("doorbell"), sizeof(Doorbell), owner, error)
            || !pipe.find(paths.pipe, QStringLiteral("pipe"), owner, error))
            return false;
        m_descriptor = pipe.openPipe(error);
        return m_descriptor >= 0;
    }
    Status receive(const char **frame, std::size_t *size) noexcept override
    {
        if (poll(frame, size) == Received)
            return Received;
        channel()->inputs.wait();
        return poll(frame, size);
    }
    Status poll(const char **frame, std::size_t *size) noexcept override
    {
        *frame = m_frame.data();
        *size = channel()->inputs.pop(m_frame.data(), m_frame.size());
        return *size > 0 ? Received : Nothing;
    }
    bool send(const char *frame, std::size_t size) noexcept override { return channel()->outputs.push(frame, size); }
    void flush() noexcept override { static_cast<Doorbell *>(m_bell.data())->ring(m_descriptor); }

private:
    SharedChannel *channel() const noexcept { return static_cast<SharedChannel *>(m_memory.data()); }

    SharedMemory m_memory;
    SharedMemory m_bell;
    std::array<char, 2048> m_frame{};
};

}  // namespace

CyclicLink::~CyclicLink()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

bool CyclicLink::joinGroup(const SocketAddress &, QString *error)
{
    *error = QStringLiteral("only UDP knows multicast groups");
    return false;
}

std::unique_ptr<CyclicLink> CyclicLink::local(const LocalPaths &paths, uid_t owner, QString *error)
{
    auto link = std::make_unique<LocalLink>();
    return link->open(paths, owner, error) ? std::move(link) : nullptr;
}

std::unique_ptr<CyclicLink> CyclicLink::udp(const SocketAddress &master, quint16 *localPort, QString *error)
{
    const int descriptor = ::socket(master.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) {
        *error = QStringLiteral("no UDP socket: %1").arg(systemErrorText());
        return nullptr;
    }
    auto link = std::make_unique<UdpLink>(descriptor);
    SocketAddress local;
    local.length = sizeof local.storage;
    if (::connect(descriptor, master.data(), master.length) < 0
        || ::getsockname(descriptor, local.data(), &local.length) < 0) {
        *error = QStringLiteral("no UDP socket towards %1: %2").arg(master.toString(), systemErrorText());
        return nullptr;
    }
    *localPort = local.port();
    return link;
}

std::unique_ptr<CyclicLink> CyclicLink::tcp(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
{
    // Qt made it non-blocking; the cycle thread wants to wait in recv().
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    const int on = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const timeval longestSend{0, 50'000};
    ::setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &longestSend, sizeof longestSend);
    return std::make_unique<TcpLink>(descriptor, cutter, largestFrame);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "UdpLink.h"

#include <cerrno>
#include <sys/socket.h>

namespace qplc {

std::unique_ptr<CyclicLink> UdpLink::open(const SocketAddress &master, quint16 *localPort, QString *error)
{
    std::unique_ptr<UdpLink> link(new UdpLink(::socket(master.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0)));
    return link->connectTo(master, localPort, error) ? std::move(link) : nullptr;
}

bool UdpLink::connectTo(const SocketAddress &master, quint16 *localPort, QString *error)
{
    const int descriptor = m_descriptor;
    if (descriptor < 0) {
        *error = QStringLiteral("no UDP socket: %1").arg(systemErrorText());
        return false;
    }
    SocketAddress local;
    local.length = sizeof local.storage;
    if (::connect(descriptor, master.data(), master.length) < 0
        || ::getsockname(descriptor, local.data(), &local.length) < 0) {
        *error = QStringLiteral("no UDP socket towards %1: %2").arg(master.toString(), systemErrorText());
        return false;
    }
    *localPort = local.port();
    return true;
}

CyclicLink::Status UdpLink::poll(const char **frame, std::size_t *size) noexcept
{
    return read(frame, size, MSG_DONTWAIT);
}

bool UdpLink::send(const char *frame, std::size_t size) noexcept
{
    return ::send(m_descriptor, frame, size, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(size);
}

CyclicLink::Status UdpLink::read(const char **frame, std::size_t *size, int flags) noexcept
{
    const ssize_t count = ::recv(m_source, m_buffer.data(), m_buffer.size(), flags);
    if (count < 0) {
        // A master that is gone answers with "port unreachable": no reason to give the socket up.
        return isTransient(errno) || errno == ECONNREFUSED ? Nothing : Closed;
    }
    *frame = m_buffer.data();
    *size = std::size_t(count);
    return Received;
}

}  // namespace qplc

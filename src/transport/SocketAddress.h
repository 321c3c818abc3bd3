// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtNetwork/QHostAddress>
#include <sys/socket.h>

namespace qplc {

/// An IP address and port as the kernel takes it.
struct SocketAddress
{
    sockaddr_storage storage{};
    socklen_t length = 0;

    SocketAddress() = default;
    /// QHostAddress::Any becomes the IPv6 address :: (see CyclicHub::open()).
    SocketAddress(const QHostAddress &address, quint16 port);
    /// The same address for a socket of IPv6: an IPv4 address a.b.c.d becomes ::ffff:a.b.c.d.
    SocketAddress mappedToIpv6() const;

    const sockaddr *data() const { return reinterpret_cast<const sockaddr *>(&storage); }
    sockaddr *data() { return reinterpret_cast<sockaddr *>(&storage); }
    int family() const { return storage.ss_family; }
    quint16 port() const;
    /// Equal for equal addresses; what peers are looked up by. An IPv4 address mapped into IPv6
    /// counts as the IPv4 address.
    quint64 key() const;
    QString toString() const;
};

/// "Address already in use": text of the current errno.
QString systemErrorText();

}  // namespace qplc

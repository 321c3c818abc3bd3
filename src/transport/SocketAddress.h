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
    /// A number to look peers up by: equal for equal addresses. Two IPv6 addresses that are not
    /// equal may have the same number, so compare them, too.
    quint64 key() const;
    QString toString() const;
    /// Whether address, port and, of IPv6, the scope are the same. An IPv4 address mapped into IPv6
    /// is the same as the IPv4 address.
    friend bool operator==(const SocketAddress &one, const SocketAddress &other);
};

/// "Address already in use": text of the current errno.
QString systemErrorText();

}  // namespace qplc

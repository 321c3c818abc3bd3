// SPDX-License-Identifier: Apache-2.0
#include "SocketAddress.h"

#include <QtCore/QHashFunctions>
#include <QtCore/qendian.h>
#include <cerrno>
#include <cstring>
#include <net/if.h>
#include <netinet/in.h>

namespace qplc {

namespace {

constexpr quint64 ofIpv6 = quint64(1) << 48;  // an IPv4 address and its port have 48 bits

constexpr quint64 keyOfIpv4(quint32 address, quint16 port)
{
    return (quint64(address) << 16) | port;
}

const sockaddr_in6 &ipv6Of(const SocketAddress &address)
{
    return *reinterpret_cast<const sockaddr_in6 *>(&address.storage);
}

/// "eth0" or "2", as behind the % of fe80::1%eth0; 0: none.
quint32 scopeOf(const QString &scope)
{
    if (scope.isEmpty())
        return 0;  // without a system call
    const quint32 index = ::if_nametoindex(scope.toLocal8Bit().constData());
    return index != 0 ? index : scope.toUInt();
}

}  // namespace

SocketAddress::SocketAddress(const QHostAddress &address, quint16 port)
{
    bool isIpv4 = false;
    const quint32 ipv4 = address.toIPv4Address(&isIpv4);
    isIpv4 = isIpv4 && (ipv4 != 0 || address.protocol() == QAbstractSocket::IPv4Protocol);  // Qt takes :: for 0.0.0.0
    if (isIpv4) {
        auto *target = reinterpret_cast<sockaddr_in *>(&storage);
        target->sin_family = AF_INET;
        target->sin_port = qToBigEndian(port);
        target->sin_addr.s_addr = qToBigEndian(ipv4);
        length = sizeof(sockaddr_in);
        return;
    }
    auto *target = reinterpret_cast<sockaddr_in6 *>(&storage);
    const Q_IPV6ADDR ipv6 = address.toIPv6Address();
    target->sin6_family = AF_INET6;
    target->sin6_port = qToBigEndian(port);
    std::memcpy(&target->sin6_addr, &ipv6, sizeof ipv6);
    target->sin6_scope_id = scopeOf(address.scopeId());
    length = sizeof(sockaddr_in6);
}

SocketAddress SocketAddress::mappedToIpv6() const
{
    if (family() != AF_INET)
        return *this;
    SocketAddress mapped(QHostAddress(QHostAddress::AnyIPv6), port());
    in6_addr &address = reinterpret_cast<sockaddr_in6 *>(&mapped.storage)->sin6_addr;
    address.s6_addr[10] = address.s6_addr[11] = 0xff;
    std::memcpy(&address.s6_addr[12], &reinterpret_cast<const sockaddr_in *>(&storage)->sin_addr, 4);
    return mapped;
}

quint16 SocketAddress::port() const
{
    const auto *ipv4 = reinterpret_cast<const sockaddr_in *>(&storage);
    return qFromBigEndian(ipv4->sin_port);  // at the same place in sockaddr_in6
}

quint64 SocketAddress::key() const
{
    if (family() == AF_INET)
        return keyOfIpv4(reinterpret_cast<const sockaddr_in *>(&storage)->sin_addr.s_addr, port());
    const in6_addr &address = ipv6Of(*this).sin6_addr;
    if (IN6_IS_ADDR_V4MAPPED(&address)) {
        quint32 ipv4 = 0;
        std::memcpy(&ipv4, &address.s6_addr[12], 4);
        return keyOfIpv4(ipv4, port());
    }
    return ofIpv6 | (quint64(qHashBits(&address, sizeof address)) << 16) | port();
}

bool operator==(const SocketAddress &one, const SocketAddress &other)
{
    const quint64 key = one.key();
    if (key != other.key())
        return false;
    return (key & ofIpv6) == 0
        || (IN6_ARE_ADDR_EQUAL(&ipv6Of(one).sin6_addr, &ipv6Of(other).sin6_addr)
            && ipv6Of(one).sin6_scope_id == ipv6Of(other).sin6_scope_id);
}

QString SocketAddress::toString() const
{
    return QStringLiteral("%1:%2").arg(QHostAddress(data()).toString()).arg(port());
}

QString systemErrorText()
{
    return QString::fromLocal8Bit(std::strerror(errno));
}

}  // namespace qplc

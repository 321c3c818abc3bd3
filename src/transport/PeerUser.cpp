// SPDX-License-Identifier: Apache-2.0
#include "PeerUser.h"

#include <QtCore/QFile>

#include <cstring>
#include <netinet/in.h>

namespace qplc {

namespace {

enum TcpColumn { OwnAddress = 1, OtherAddress = 2, State = 3, User = 7 };
const QByteArray established = QByteArrayLiteral("01");

/// "0100007F:C350": 32-bit words as this machine reads them, then the port.
QByteArray tableText(const void *address, std::size_t words, quint16 port)
{
    QByteArray text;
    for (std::size_t i = 0; i < words; ++i) {
        quint32 word = 0;
        std::memcpy(&word, static_cast<const char *>(address) + i * sizeof word, sizeof word);
        text += QByteArray::number(word, 16).rightJustified(8, '0');
    }
    return (text + ':' + QByteArray::number(port, 16).rightJustified(4, '0')).toUpper();
}

QByteArray tableText(const SocketAddress &address)
{
    if (address.family() == AF_INET)
        return tableText(&reinterpret_cast<const sockaddr_in *>(address.data())->sin_addr, 1, address.port());
    return tableText(&reinterpret_cast<const sockaddr_in6 *>(address.data())->sin6_addr, 4, address.port());
}

std::optional<uid_t> findIn(const char *table, const QByteArray &own, const QByteArray &other)
{
    QFile file(QString::fromLatin1(table));
    if (!file.open(QIODevice::ReadOnly))
        return std::nullopt;
    for (QByteArray line = file.readLine(); !line.isEmpty(); line = file.readLine()) {
        const QList<QByteArray> columns = line.simplified().split(' ');
        if (columns.size() > User && columns[OwnAddress] == own && columns[OtherAddress] == other
            && columns[State] == established)
            return uid_t(columns[User].toUInt());
    }
    return std::nullopt;
}

}  // namespace

std::optional<uid_t> userOfPeer(const SocketAddress &self, const SocketAddress &peer)
{
    if (self.family() == AF_INET && peer.family() == AF_INET) {
        if (const auto user = findIn("/proc/net/tcp", tableText(peer), tableText(self)))
            return user;
    }
    return findIn("/proc/net/tcp6", tableText(peer.mappedToIpv6()), tableText(self.mappedToIpv6()));
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "LocalSocket.h"

#include <cstddef>
#include <cstring>

namespace qplc::LocalSocket {

Descriptor make()
{
    return Descriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

socklen_t addressOf(std::uint64_t session, sockaddr_un *address)
{
    *address = {};
    address->sun_family = AF_UNIX;
    QByteArray name(1, '\0');  // no file
    name += "qtplc-" + QByteArray::number(quint64(session), 16).rightJustified(16, '0');
    std::memcpy(address->sun_path, name.constData(), std::size_t(name.size()));
    return socklen_t(offsetof(sockaddr_un, sun_path) + std::size_t(name.size()));
}

uid_t userOfPeer(int socket)
{
    ucred peer{};
    socklen_t size = sizeof peer;
    return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 ? peer.uid : uid_t(-1);
}

}  // namespace qplc::LocalSocket

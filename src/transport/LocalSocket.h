// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Descriptor.h"
#include "SocketAddress.h"

#include <QtCore/QString>

#include <cstdint>
#include <sys/types.h>
#include <sys/un.h>

namespace qplc {

/// The Unix sockets over which a master passes descriptors to local nodes. They have a name without
/// a file, made of the session of the master: nobody can take it before the master, the kernel
/// forgets it with the process, and it is known to the programs that reach the master over the
/// loopback.
namespace LocalSocket {

/// \return a socket that never waits; none: the reason is in errno
Descriptor make();
/// The address of the master with this session. \return its length
socklen_t addressOf(std::uint64_t session, sockaddr_un *address);
/// The user who has called connect() or listen() at the other end, as the kernel says.
/// \return uid_t(-1), with the reason in errno, when it does not
uid_t userOfPeer(int socket);

}  // namespace LocalSocket

}  // namespace qplc

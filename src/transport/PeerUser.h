// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SocketAddress.h"

#include <optional>
#include <sys/types.h>

namespace qplc {

/// The user of the program at the other end of a TCP connection within this machine, as the kernel
/// says. It cannot be forged by that program.
///
/// Looks into /proc/net/tcp and tcp6 for the socket whose own address is \a peer and whose other
/// end is \a self.
/// \return nothing when the other end is on another machine, or has closed the connection: its row
///         then says 0, which is root
std::optional<uid_t> userOfPeer(const SocketAddress &self, const SocketAddress &peer);

}  // namespace qplc

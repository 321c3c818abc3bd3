// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SocketAddress.h"

#include <linux/filter.h>
#include <vector>

namespace qplc {

/// Programs of classic BPF with which the kernel tells the datagrams of peers from all others.
///
/// They select one of two sockets that are bound to the same UDP port (SO_ATTACH_REUSEPORT_CBPF).
namespace datagramFilter {

constexpr std::uint32_t ofPeers = 0;      // the socket that was bound first
constexpr std::uint32_t ofStrangers = 1;  // the other one

using Program = std::vector<sock_filter>;

/// Compares address and port of the sender: longer than the kernel allows if there are very many
/// addresses.
Program byAddress(const std::vector<SocketAddress> &peers);
/// Compares the port of the sender alone: shorter.
Program byPort(const std::vector<SocketAddress> &peers);

}  // namespace datagramFilter

}  // namespace qplc

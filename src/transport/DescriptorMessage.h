// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Descriptor.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace qplc {

/// A message on a Unix socket (SOCK_SEQPACKET): eight bytes with a key, and descriptors that the
/// kernel copies into the process of the receiver.
struct DescriptorMessage
{
    /// Most of one message.
    static constexpr std::size_t MaximumDescriptors = 4;

    std::uint64_t key = 0;
    std::vector<Descriptor> descriptors;
};

/// Never waits. \return false, with the reason in errno
bool sendDescriptors(int socket, std::uint64_t key, const std::vector<int> &descriptors) noexcept;

/// Takes the next message, and never waits for one. Descriptors are closed when a program is run.
/// \return nothing, with the reason in errno: EAGAIN as long as none is there, ECONNRESET when the
///         other end is closed, EBADMSG for another message than a DescriptorMessage. None of its
///         descriptors stays open then
std::optional<DescriptorMessage> receiveDescriptors(int socket);

}  // namespace qplc

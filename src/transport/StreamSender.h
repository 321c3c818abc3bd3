// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace qplc {

/// Sends whole frames into a stream. A frame that has begun is always finished before the next one,
/// whatever the kernel takes at a time: else the receiver could not tell any more where a frame
/// begins. Allocation-free after construction.
class StreamSender
{
public:
    explicit StreamSender(std::size_t largestFrame);

    /// \param flags MSG_DONTWAIT: never waits; 0: at most the time-out of the socket, or until a
    ///         signal comes
    /// \return false when the frame was left out, because the kernel takes nothing at present
    bool send(int descriptor, const char *frame, std::size_t size, int flags) noexcept;
    /// Goes on with the frame that has begun. \return false when some of it is still to be sent
    bool sendRest(int descriptor, int flags) noexcept;
    bool hasRest() const { return m_begin < m_end; }

private:
    std::unique_ptr<char[]> m_rest;  // of a frame that the kernel took only in part
    std::size_t m_capacity;
    std::size_t m_begin = 0;
    std::size_t m_end = 0;
};

}  // namespace qplc

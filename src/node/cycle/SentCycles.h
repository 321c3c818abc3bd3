// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/CyclicFrame.h"

#include <cstdint>
#include <optional>

namespace qplc {

/// Which cycles of a phase a master has sent to a node, or to a group of nodes. So the node can
/// tell a cycle that was lost on the way from one that was never sent to it (the header of frames:
/// `before`).
class SentCycles
{
public:
    /// The last cycle that was sent.
    struct Last
    {
        std::uint64_t cycle = 0;   // number on the wire
        std::uint16_t before = 0;  // as in its frames
    };

    /// A phase begins: \a first is the first cycle that may be sent (number on the wire).
    void restart(std::uint64_t first) noexcept
    {
        m_first = first;
        m_count = 0;
    }
    /// How many cycles before \a cycle were not sent, modulo 2^16.
    std::uint16_t unsentBefore(std::uint64_t cycle) const noexcept { return std::uint16_t(cycle - m_first - m_count); }
    /// The frames with \a header were given to the transport.
    void note(const FrameHeader &header) noexcept
    {
        m_last = {header.cycle, header.before};
        ++m_count;
    }
    /// None: nothing was sent.
    std::optional<Last> last() const { return m_count > 0 ? std::optional<Last>(m_last) : std::nullopt; }

private:
    std::uint64_t m_first = 0;
    std::uint64_t m_count = 0;
    Last m_last;
};

}  // namespace qplc

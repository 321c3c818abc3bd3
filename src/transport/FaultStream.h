// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DelayLine.h"
#include "FaultInjector.h"

namespace qplc {

/// One direction of one stream of frames, with what its FaultInjector decides carried out.
/// Allocation-free after construction; used by one thread.
class FaultStream
{
public:
    static constexpr std::size_t LargestFrame = 2048;  // [byte] longer than every frame

    FaultStream(const FaultPlan::Direction &plan, std::uint64_t seed, std::uint64_t stream);

    /// Whether \a frame goes on as it is, at once. Else it is gone, or comes out of \a line (for \a
    /// owner) when it is due, as all copies do.
    bool passes(std::int64_t now, const char *frame, std::size_t size, DelayLine &line, void *owner) noexcept;
    const FaultInjector &injector() const { return m_injector; }

private:
    void hold(const char *frame, std::size_t size, std::uint64_t flips) noexcept;

    FaultInjector m_injector;
    std::vector<char> m_held;  // comes behind the next frame
    std::size_t m_heldSize = 0;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "FaultStream.h"

#include <cstring>

namespace qplc {

FaultStream::FaultStream(const FaultPlan::Direction &plan, std::uint64_t seed, std::uint64_t stream)
    : m_injector(plan, seed, stream)
    , m_held(LargestFrame)
{
}

void FaultStream::hold(const char *frame, std::size_t size, std::uint64_t flips) noexcept
{
    std::memcpy(m_held.data(), frame, size);
    m_heldSize = size;
    if (flips != 0)
        FaultInjector::corrupt(flips, m_held.data(), size);
}

bool FaultStream::passes(std::int64_t now, const char *frame, std::size_t size, DelayLine &line, void *owner) noexcept
{
    const FaultInjector::Decision decision = m_injector.decide(now);
    if (!decision.passes || size > LargestFrame)
        return decision.passes;
    if (decision.isHeld) {
        if (decision.isDuplicated)
            line.put(now + decision.copyDelay, owner, frame, size);
        hold(frame, size, decision.flips);
        return false;
    }
    const bool isUntouched = decision.flips == 0 && decision.delay == 0;
    if (!isUntouched) {
        char *copy = line.put(now + decision.delay, owner, frame, size);
        if (copy && decision.flips != 0)
            FaultInjector::corrupt(decision.flips, copy, size);
    }
    if (decision.isDuplicated)
        line.put(now + decision.copyDelay, owner, frame, size);
    if (m_heldSize > 0)
        line.put(now + decision.delay, owner, m_held.data(), m_heldSize);
    m_heldSize = 0;
    return isUntouched;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "HubFaults.h"

#include <algorithm>

namespace qplc {

namespace {

/// Frames of all peers under way in each direction; what comes then is lost.
constexpr std::size_t framesOfAllLinks = 2048;

}  // namespace

HubFaults::HubFaults(const FaultPlan &plan, TimeSource &time)
    : m_plan(plan)
    , m_time(time)
    , m_sending(framesOfAllLinks, FaultStream::LargestFrame)
    , m_receiving(framesOfAllLinks, FaultStream::LargestFrame)
{
}

std::int64_t HubFaults::timeLeft(std::int64_t longest) noexcept
{
    const std::int64_t due = std::min(m_sending.nextDue(), m_receiving.nextDue());
    return due == DelayLine::Never ? longest : std::clamp<std::int64_t>(due - m_time.now(), 0, longest);
}

void HubFaults::forget(const void *peer) noexcept
{
    m_sending.forget(peer);
    m_receiving.forget(peer);
}

}  // namespace qplc

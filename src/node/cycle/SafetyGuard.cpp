// SPDX-License-Identifier: Apache-2.0
#include "SafetyGuard.h"

#include <algorithm>

namespace qplc {

SafetyGuard::SafetyGuard(CycleReports &reports)
    : m_reports(reports)
{
}

void SafetyGuard::start(const Limits &limits)
{
    m_limits = limits;
    m_overruns = 0;
    m_slept = -1;
    m_tripped = false;
}

void SafetyGuard::begin(const CycleClock::Tick &tick, std::int64_t period, std::int64_t slept) noexcept
{
    const std::int64_t pause = m_slept < 0 ? 0 : slept - m_slept;  // the clock of the cycles stood still meanwhile
    const std::int64_t gap = tick.lateness + std::int64_t(tick.skipped) * period + pause;
    m_slept = slept;
    if (m_limits.gap > 0 && gap > m_limits.gap)
        trip(CycleEvent::TrippedByGap, 0, tick.cycle, gap);
    m_overruns = tick.overrun ? m_overruns + 1 : 0;
    if (m_limits.overruns > 0 && m_overruns > m_limits.overruns)
        trip(CycleEvent::TrippedByOverruns, 0, tick.cycle, gap);
}

void SafetyGuard::answeredInTime(NodeSlot &slot) noexcept
{
    const int level = slot.bucket.load(std::memory_order_relaxed);
    if (level > 0)
        slot.bucket.store(level - 1, std::memory_order_relaxed);
}

void SafetyGuard::answeredLate(NodeSlot &slot, std::uint64_t cycle) noexcept
{
    const int level = std::min(slot.bucket.load(std::memory_order_relaxed) + LateCosts, BucketLimit);
    slot.bucket.store(level, std::memory_order_relaxed);
    if (slot.policy == QPlcSlaveNode::SafeStopWhenLate)
        trip(CycleEvent::TrippedByLateAnswer, slot.id, cycle, 0);
    else if (slot.critical && level >= BucketLimit)
        trip(CycleEvent::TrippedByLateAnswers, slot.id, cycle, 0);
}

void SafetyGuard::codeFailed(const NodeSlot &slot, std::uint64_t cycle) noexcept
{
    if (slot.critical)
        trip(CycleEvent::TrippedByFailure, slot.id, cycle, 0);
}

void SafetyGuard::becameSafe(const NodeSlot &slot, std::uint64_t cycle) noexcept
{
    if (slot.critical)
        trip(CycleEvent::TrippedBySafeNode, slot.id, cycle, 0);
}

void SafetyGuard::askedBy(const NodeSlot &slot, std::uint64_t cycle) noexcept
{
    trip(CycleEvent::TrippedByNode, slot.id, cycle, 0);
}

bool SafetyGuard::waitedFor(const NodeSlot &slot, std::uint64_t cycle, std::int64_t waited) noexcept
{
    if (m_limits.longestWait == 0 || waited < m_limits.longestWait)
        return false;
    trip(CycleEvent::TrippedByWait, slot.id, cycle, waited);
    return true;
}

/// The first reason counts: what follows is its echo.
void SafetyGuard::trip(CycleEvent::Kind kind, std::uint16_t node, std::uint64_t cycle, std::int64_t duration) noexcept
{
    if (!m_tripped.exchange(true, std::memory_order_acq_rel))
        m_reports.post({kind, node, 0, cycle, duration});
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleReports.h"
#include "NodeSlot.h"
#include "realtime/CycleClock.h"

#include <atomic>

namespace qplc {

/// Watches the limits of a phase and decides when a master has to stop safely. Once tripped it
/// stays so until the next phase.
///
/// Looks at no clock. Used by the cycle thread; request() and isTripped() from anywhere.
class SafetyGuard
{
public:
    /// All in ns on the clock of the machine; 0: no such limit.
    struct Limits
    {
        std::int64_t gap = 0;          // longest time by which a cycle may begin late
        std::int64_t longestWait = 0;  // for late nodes; External: in a step
        int overruns = 0;              // in a row
    };
    /// What a late answer of a critical node adds to its bucket, and where the bucket is full; one
    /// in time takes 1 off.
    static constexpr int LateCosts = 2;
    static constexpr int BucketLimit = 10;

    explicit SafetyGuard(CycleReports &reports);

    /// Before a phase.
    void start(const Limits &limits);
    /// Stops safely from the next cycle on. Its thread is that of the master, who knows why.
    void request() noexcept { m_tripped.store(true, std::memory_order_release); }
    bool isTripped() const noexcept { return m_tripped.load(std::memory_order_acquire); }

    // ---- cycle thread ----
    /// [ns]; 0: for ever
    std::int64_t longestWait() const noexcept { return m_limits.longestWait; }
    /// A cycle begins. \param period  [ns] of the grid; 0: not timed
    /// \param slept  [ns] that the computer has slept since it was switched on
    void begin(const CycleClock::Tick &tick, std::int64_t period, std::int64_t slept) noexcept;
    void answeredInTime(NodeSlot &slot) noexcept;
    void answeredLate(NodeSlot &slot, std::uint64_t cycle) noexcept;
    /// An answer of a node says that its code has failed.
    void codeFailed(const NodeSlot &slot, std::uint64_t cycle) noexcept;
    /// An answer of a node says that it is in its safe state, and the master has not told it to be.
    void becameSafe(const NodeSlot &slot, std::uint64_t cycle) noexcept;
    /// A node wants the master to stop safely.
    void askedBy(const NodeSlot &slot, std::uint64_t cycle) noexcept;
    /// \param waited  [ns] for \a slot, until now. \return whether that is too long
    bool waitedFor(const NodeSlot &slot, std::uint64_t cycle, std::int64_t waited) noexcept;

private:
    void trip(CycleEvent::Kind kind, std::uint16_t node, std::uint64_t cycle, std::int64_t duration) noexcept;

    CycleReports &m_reports;
    Limits m_limits;
    int m_overruns = 0;         // in a row
    std::int64_t m_slept = -1;  // [ns] at the last cycle; -1: there was none
    std::atomic<bool> m_tripped{false};
};

}  // namespace qplc

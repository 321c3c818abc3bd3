// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TimeSource.h"

#include <cstdint>

namespace qplc {

/// The grid t_k = t0 + k * period and where the cycle stands on it. Pure arithmetic on a TimeSource; allocation-free.
///
/// SkipToGrid: when the deadline of the next cycle has passed by a whole period or more, the cycles that can no longer
/// be on time are skipped and counted, so that the phase never moves and the number of a cycle always tells its nominal
/// time.
class CycleClock
{
public:
    struct Tick
    {
        std::uint64_t cycle = 0;    ///< number of the cycle to compute
        std::uint64_t skipped = 0;  ///< cycles left out before it
        std::int64_t lateness = 0;  ///< actual wake-up - nominal time of `cycle` [ns], 0 ... period - 1
        bool interrupted = false;   ///< woken before its time because stop was asked for
    };

    /// \param period  [ns] between two cycles on the clock of \a time; 0: lockstep, no waiting and no look at the clock
    CycleClock(TimeSource &time, std::int64_t period);

    /// Cycle 0 becomes due now.
    void start() noexcept;
    /// Waits for the next cycle. An interrupted wait consumes no cycle: the next call waits for the same one.
    /// When the cycle is due already (overload, lockstep), nobody is asked: the caller also looks between two cycles.
    /// \param shouldStop  asked before the sleep, after every interruption of it, and at least each 50 ms
    template<typename ShouldStop>
    Tick next(ShouldStop shouldStop) noexcept;
    /// Shifts the grid by \a duration [ns]: time stood still (Wait policies).
    void shift(std::int64_t duration) noexcept { m_origin += duration; }

    /// Nominal time of cycle \a cycle on the clock [ns].
    std::int64_t nominal(std::uint64_t cycle) const noexcept { return m_origin + std::int64_t(cycle) * m_period; }
    std::int64_t period() const noexcept { return m_period; }

private:
    Tick arrive() noexcept;

    TimeSource &m_time;
    std::int64_t m_period = 0;
    std::int64_t m_origin = 0;
    std::uint64_t m_next = 0;
};

template<typename ShouldStop>
CycleClock::Tick CycleClock::next(ShouldStop shouldStop) noexcept
{
    constexpr std::int64_t slice = 50'000'000;  // [ns] a stop is never noticed later than this
    if (m_period > 0) {
        const std::int64_t deadline = nominal(m_next);
        for (std::int64_t now = m_time.now(); now < deadline; now = m_time.now()) {
            if (shouldStop()) {
                Tick tick;
                tick.cycle = m_next;
                tick.interrupted = true;
                return tick;
            }
            m_time.sleepUntil(deadline - now > slice ? now + slice : deadline);
        }
    }
    return arrive();
}

}  // namespace qplc

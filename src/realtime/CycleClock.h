// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcOverrunPolicy.h"
#include "TimeSource.h"

#include <cstdint>

namespace qplc {

/// The grid t_k = t0 + k * period and where the cycle stands on it. Pure arithmetic on a
/// TimeSource; allocation-free.
///
/// When the next cycle can begin only a period or more after its nominal time (an overrun), the
/// QPlcOverrunPolicy says which cycle comes next and whether the grid moves. Else the grid never
/// moves by itself, so that the number of a cycle tells its nominal time.
class CycleClock
{
public:
    struct Tick
    {
        std::uint64_t cycle = 0;    ///< number of the cycle to compute
        std::uint64_t skipped = 0;  ///< cycles left out before it
        std::int64_t woken = 0;     ///< when it begins, on the clock [ns]
        std::int64_t lateness = 0;  ///< woken - nominal time of `cycle` on the grid so far [ns], never negative
        std::int64_t deadline = 0;  ///< when it has to have ended [ns]
        std::int64_t shift = 0;     ///< by which the grid has moved [ns] (Shift)
        bool overrun = false;       ///< an overrun was found: counts once, also when several cycles are caught up
        bool caughtUp = false;      ///< its period is over, it runs nevertheless (CatchUp)
        bool stopped = false;       ///< not to be computed: the policy is Stop; consumes no cycle
        bool interrupted = false;   ///< woken before its time because stop was asked for; consumes no cycle
    };

    /// \param period [ns] between two cycles on the clock of \a time; 0: lockstep, no waiting and
    ///         no look at the clock
    /// \param policy  valid
    CycleClock(TimeSource &time, std::int64_t period, QPlcOverrunPolicy policy = {});

    /// Cycle 0 becomes due now.
    void start() noexcept;
    /// Waits for the next cycle. An interrupted wait consumes no cycle: the next call waits for the
    /// same one. When the cycle is due already (overload, lockstep), nobody is asked: the caller
    /// also looks between two cycles.
    /// \param shouldStop asked before the sleep, after every interruption of it, and at least each
    ///         50 ms
    template<typename ShouldStop>
    Tick next(ShouldStop shouldStop) noexcept;
    /// Shifts the grid by \a duration [ns]: time stood still (Wait policies).
    void shift(std::int64_t duration) noexcept { m_origin += duration; }

    /// Nominal time of cycle \a cycle on the clock [ns].
    std::int64_t nominal(std::uint64_t cycle) const noexcept { return m_origin + std::int64_t(cycle) * m_period; }
    std::int64_t period() const noexcept { return m_period; }

private:
    Tick arrive() noexcept;
    void followPolicy(std::uint64_t missed, Tick *tick) noexcept;
    void skip(std::uint64_t cycles, Tick *tick) const noexcept;
    void catchUp(std::uint64_t missed, Tick *tick) noexcept;

    TimeSource &m_time;
    std::int64_t m_period = 0;
    QPlcOverrunPolicy m_policy;
    std::int64_t m_origin = 0;
    std::uint64_t m_next = 0;
    std::uint64_t m_caughtUp = 0;  // missed cycles that ran in a row
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

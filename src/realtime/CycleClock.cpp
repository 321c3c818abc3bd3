// SPDX-License-Identifier: Apache-2.0
#include "CycleClock.h"

#include <algorithm>

namespace qplc {

CycleClock::CycleClock(TimeSource &time, std::int64_t period, QPlcOverrunPolicy policy)
    : m_time(time)
    , m_period(std::max<std::int64_t>(period, 0))
    , m_policy(policy)
{
}

void CycleClock::start() noexcept
{
    m_origin = m_period > 0 ? m_time.now() : 0;  // lockstep knows no clock
    m_next = 0;
    m_caughtUp = 0;
}

CycleClock::Tick CycleClock::arrive() noexcept
{
    Tick tick;
    tick.cycle = m_next;
    if (m_period > 0) {
        tick.woken = m_time.now();
        tick.lateness = std::max<std::int64_t>(tick.woken - nominal(m_next), 0);
        if (tick.lateness >= m_period)
            followPolicy(std::uint64_t(tick.lateness / m_period), &tick);
        else
            m_caughtUp = 0;
        // Nobody can answer in a period that is over: a cycle that is caught up has a period of its
        // own.
        tick.deadline = tick.caughtUp ? tick.woken + m_period : nominal(tick.cycle + 1);
    }
    if (!tick.stopped)
        m_next = tick.cycle + 1;
    return tick;
}

/// \param missed  cycles whose period is over, \a tick->cycle being the first of them
void CycleClock::followPolicy(std::uint64_t missed, Tick *tick) noexcept
{
    tick->overrun = m_caughtUp == 0;  // else it is known already
    switch (m_policy.kind()) {
    case QPlcOverrunPolicy::SkipToGrid:
        skip(missed, tick);
        break;
    case QPlcOverrunPolicy::CatchUp:
        catchUp(missed, tick);
        break;
    case QPlcOverrunPolicy::Shift:
        tick->shift = tick->lateness;
        m_origin += tick->shift;
        break;
    case QPlcOverrunPolicy::Stop:
        tick->stopped = true;
        break;
    }
}

void CycleClock::skip(std::uint64_t cycles, Tick *tick) const noexcept
{
    tick->skipped = cycles;
    tick->cycle += cycles;
    tick->lateness -= std::int64_t(cycles) * m_period;
}

/// The newest of the missed cycles run, as many as are left of those allowed in a row; then the
/// grid goes on.
void CycleClock::catchUp(std::uint64_t missed, Tick *tick) noexcept
{
    const std::uint64_t allowed = std::uint64_t(m_policy.catchUpCycles()) - m_caughtUp;
    const std::uint64_t run = std::min(missed, allowed);
    skip(missed - run, tick);
    tick->caughtUp = run > 0;
    m_caughtUp = run > 0 ? m_caughtUp + 1 : 0;
}

}  // namespace qplc

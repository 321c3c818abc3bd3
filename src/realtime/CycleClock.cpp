// SPDX-License-Identifier: Apache-2.0
#include "CycleClock.h"

#include <algorithm>

namespace qplc {

CycleClock::CycleClock(TimeSource &time, std::int64_t period)
    : m_time(time)
    , m_period(std::max<std::int64_t>(period, 0))
{
}

void CycleClock::start() noexcept
{
    m_origin = m_period > 0 ? m_time.now() : 0;  // lockstep knows no clock
    m_next = 0;
}

CycleClock::Tick CycleClock::arrive() noexcept
{
    Tick tick;
    if (m_period > 0) {
        const std::int64_t late = std::max<std::int64_t>(m_time.now() - nominal(m_next), 0);
        tick.skipped = std::uint64_t(late / m_period);
        tick.lateness = late % m_period;
    }
    tick.cycle = m_next + tick.skipped;
    m_next = tick.cycle + 1;
    return tick;
}

}  // namespace qplc

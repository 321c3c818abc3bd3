// SPDX-License-Identifier: Apache-2.0
#include "AlarmState.h"

#include <cmath>

namespace qplc {

void AlarmState::setLimits(const AlarmLimits &limits)
{
    *this = AlarmState();
    m_limits = limits;
}

/// How far a value is beyond the limits of one side; a level that holds has the limit nearer to
/// normal.
AlarmState::Level AlarmState::levelOf(double value, Side side) const
{
    const double sign = side == High ? 1.0 : -1.0;
    const auto isBeyond = [&](const std::optional<double> &limit, Level level) {
        const bool isHeld = m_side == side && m_level >= level;
        return limit && sign * (value - *limit) > (isHeld ? -m_limits.hysteresis : 0.0);
    };
    if (isBeyond(side == High ? m_limits.alarmHigh : m_limits.alarmLow, Alarm))
        return Alarm;
    return isBeyond(side == High ? m_limits.warningHigh : m_limits.warningLow, Warning) ? Warning : Normal;
}

void AlarmState::update(double value)
{
    const Level high = levelOf(value, High);
    const Level low = levelOf(value, Low);
    m_level = high >= low ? high : low;
    m_side = m_level == Normal ? None : high >= low ? High : Low;
}

}  // namespace qplc

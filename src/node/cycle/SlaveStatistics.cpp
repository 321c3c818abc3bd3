// SPDX-License-Identifier: Apache-2.0
#include "SlaveStatistics.h"

namespace qplc {

void SlaveStatistics::restart(std::int64_t period) noexcept
{
    m_period = period;
    m_lastArrival = 0;
    m_newest.set(0);
    m_durations.clear();
}

void SlaveStatistics::answered(std::int64_t arrival, std::int64_t executionTime, std::int64_t end) noexcept
{
    const std::int64_t response = end - arrival;
    const std::int64_t interval = m_lastArrival != 0 ? arrival - m_lastArrival : Durations::None;
    m_durations.record(arrival, {executionTime, response, interval, m_period - response});
    m_lastArrival = arrival;
    m_newest.set(std::uint64_t(arrival));
}

QPlcSlaveStatistics SlaveStatistics::read(QPlcDistribution::Detail detail) const
{
    const auto newest = std::int64_t(m_newest.value());
    return {m_durations[Execution].read(newest, detail), m_durations[Response].read(newest, detail),
            m_durations[Interval].read(newest, detail), m_durations[Slack].read(newest, detail)};
}

}  // namespace qplc

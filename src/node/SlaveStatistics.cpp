// SPDX-License-Identifier: Apache-2.0
#include "SlaveStatistics.h"

namespace qplc {

void SlaveStatistics::restart(std::int64_t period) noexcept
{
    m_period = period;
    m_lastArrival = 0;
    m_newest.set(0);
    for (DurationStatistics *duration : {&m_execution, &m_response, &m_interval, &m_slack})
        duration->clear();
}

void SlaveStatistics::answered(std::int64_t arrival, std::int64_t executionTime, std::int64_t end) noexcept
{
    const std::int64_t response = end - arrival;
    m_execution.record(executionTime, arrival);
    m_response.record(response, arrival);
    m_slack.record(m_period - response, arrival);
    if (m_lastArrival != 0)
        m_interval.record(arrival - m_lastArrival, arrival);
    m_lastArrival = arrival;
    m_newest.set(std::uint64_t(arrival));
}

QPlcSlaveStatistics SlaveStatistics::read(QPlcDistribution::Detail detail) const
{
    const auto newest = std::int64_t(m_newest.value());
    return {m_execution.read(newest, detail), m_response.read(newest, detail), m_interval.read(newest, detail),
            m_slack.read(newest, detail)};
}

}  // namespace qplc

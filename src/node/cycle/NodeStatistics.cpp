// SPDX-License-Identifier: Apache-2.0
#include "NodeStatistics.h"

namespace qplc {

void NodeStatistics::clear() noexcept
{
    for (Counter *counter : {&answers, &late, &lost, &duplicated, &reordered, &rejected, &forged, &resent})
        counter->set(0);
    m_durations.clear();
    m_requests.fill({});
    m_asked = 0;
    m_settled = 0;
    m_unplaced = 0;
}

QPlcNodeStatistics NodeStatistics::read(std::int64_t now, QPlcDistribution::Detail detail) const
{
    QPlcNodeStatistics statistics;
    statistics.execution = m_durations[Execution].read(now, detail);
    statistics.roundTrip = m_durations[RoundTrip].read(now, detail);
    statistics.slack = m_durations[Slack].read(now, detail);
    statistics.answers = answers;
    statistics.late = late;
    statistics.lost = lost;
    statistics.duplicated = duplicated;
    statistics.reordered = reordered;
    statistics.rejected = rejected;
    statistics.forged = forged;
    statistics.resent = resent;
    return statistics;
}

void NodeStatistics::asked(std::uint64_t cycle, std::int64_t begin, std::int64_t deadline) noexcept
{
    m_requests[cycle % Remembered] = {cycle, m_asked++, begin, deadline};
}

void NodeStatistics::answered(std::uint64_t cycle, std::int64_t arrival, std::int64_t executionTime) noexcept
{
    answers.add();
    Durations::Values measured{executionTime, Durations::None, Durations::None};
    const Request &request = m_requests[cycle % Remembered];
    if (request.cycle == cycle) {
        lost.add(request.ordinal - m_settled - m_unplaced);
        m_settled = request.ordinal + 1;
        m_unplaced = 0;
        measured[RoundTrip] = arrival - request.begin;
        measured[Slack] = request.deadline - arrival;
    } else {
        ++m_unplaced;
    }
    if (arrival != 0)
        m_durations.record(arrival, measured);
}

void NodeStatistics::stepped(std::int64_t end, std::int64_t executionTime, std::int64_t deadline) noexcept
{
    answers.add();
    if (end != 0)
        m_durations.record(end, {executionTime, Durations::None, deadline - end});
}

}  // namespace qplc

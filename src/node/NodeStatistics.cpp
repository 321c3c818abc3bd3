// SPDX-License-Identifier: Apache-2.0
#include "NodeStatistics.h"

namespace qplc {

void NodeStatistics::clear() noexcept
{
    for (Counter *counter : {&answers, &late, &lost, &duplicated, &reordered, &rejected, &resent})
        counter->set(0);
    for (DurationStatistics *duration : {&m_execution, &m_roundTrip, &m_slack})
        duration->clear();
    m_requests.fill({});
    m_asked = 0;
    m_settled = 0;
    m_unplaced = 0;
}

QPlcNodeStatistics NodeStatistics::read(std::int64_t now, QPlcDistribution::Detail detail) const
{
    QPlcNodeStatistics statistics;
    statistics.execution = m_execution.read(now, detail);
    statistics.roundTrip = m_roundTrip.read(now, detail);
    statistics.slack = m_slack.read(now, detail);
    statistics.answers = answers;
    statistics.late = late;
    statistics.lost = lost;
    statistics.duplicated = duplicated;
    statistics.reordered = reordered;
    statistics.rejected = rejected;
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
    if (arrival != 0)
        m_execution.record(executionTime, arrival);
    const Request &request = m_requests[cycle % Remembered];
    if (request.cycle != cycle) {
        ++m_unplaced;
        return;
    }
    lost.add(request.ordinal - m_settled - m_unplaced);
    m_settled = request.ordinal + 1;
    m_unplaced = 0;
    if (arrival == 0)
        return;
    m_roundTrip.record(arrival - request.begin, arrival);
    m_slack.record(request.deadline - arrival, arrival);
}

void NodeStatistics::stepped(std::int64_t end, std::int64_t executionTime, std::int64_t deadline) noexcept
{
    answers.add();
    if (end == 0)
        return;
    m_execution.record(executionTime, end);
    m_slack.record(deadline - end, end);
}

}  // namespace qplc

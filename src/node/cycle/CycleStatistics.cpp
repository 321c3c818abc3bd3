// SPDX-License-Identifier: Apache-2.0
#include "CycleStatistics.h"

#include "transport/CyclicHub.h"

#include <algorithm>

namespace qplc {

namespace {

QString stageName(std::size_t stage)
{
    switch (CycleStage(stage)) {
    case CycleStage::Commands:
        return QStringLiteral("commands");
    case CycleStage::Ask:
        return QStringLiteral("ask");
    case CycleStage::LocalNodes:
        return QStringLiteral("local nodes");
    case CycleStage::Collect:
        return QStringLiteral("collect");
    case CycleStage::Finish:
        return QStringLiteral("finish");
    }
    return {};
}

}  // namespace

void CycleStatistics::restart(bool lockstep, std::uint64_t strangers, std::uint64_t floods) noexcept
{
    m_lockstep = lockstep;
    m_strangersBefore = strangers;
    m_floodsBefore = floods;
    m_keptOffBefore.set(keptOff());
    m_workload = 0;
    for (Counter *counter : {&m_cycles, &m_overruns, &m_skipped, &m_caughtUp, &m_shifted, &m_lateAnswers,
                             &m_incompleteCycles, &m_strangers, &m_floods, &m_newest})
        counter->set(0);
    m_durations.clear();
    m_worst.clear();
}

// ---- cycle thread ----

void CycleStatistics::begin(const CycleClock::Tick &tick, std::int64_t period) noexcept
{
    m_record = CycleRecord();
    m_record.cycle = tick.cycle;
    m_record.skipped = tick.skipped;
    m_record.lateness = tick.lateness;
    m_overdue = tick.lateness + std::int64_t(tick.skipped) * period;
    m_woken = m_stageBegin = tick.woken;
    m_deadline = tick.caughtUp ? tick.woken : tick.deadline;  // in truth it is over already
    m_asked = 0;
    m_waited = 0;
    m_incomplete = false;
    if (m_overdue < period)
        return;
    m_overruns.add(tick.overrun ? 1 : 0);
    m_skipped.add(tick.skipped);
    m_caughtUp.add(tick.caughtUp ? 1 : 0);
    m_shifted.add(std::uint64_t(tick.shift));
}

void CycleStatistics::end(std::int64_t now) noexcept
{
    m_cycles.add();
    m_incompleteCycles.add(m_incomplete ? 1 : 0);
    if (m_lockstep)
        return;
    m_workload = m_record.execution = now - m_woken - m_waited;
    m_record.slack = std::max<std::int64_t>(m_deadline - now, 0);
    const std::int64_t roundTrip = m_record.roundTrip >= 0 ? m_record.roundTrip : Durations::None;
    m_durations.record(m_woken, {m_record.lateness, m_record.execution, roundTrip, m_record.slack});
    m_worst.offer(m_overdue + std::max(m_record.execution, m_record.roundTrip), m_record);
    m_newest.set(std::uint64_t(m_woken));
}

// ---- any thread ----

/// Frames of strangers that no cycle has seen, so far.
std::uint64_t CycleStatistics::keptOff() const
{
    return m_hub ? m_hub->keptOff() : 0;
}

QVector<QPlcWorstCycle> CycleStatistics::worst() const
{
    QVector<QPlcWorstCycle> cycles;
    for (const CycleRecord &record : m_worst.read()) {
        QPlcWorstCycle cycle;
        cycle.cycle = record.cycle;
        cycle.skipped = record.skipped;
        cycle.lateness = record.lateness;
        cycle.execution = record.execution;
        cycle.roundTrip = std::max<std::int64_t>(record.roundTrip, 0);
        cycle.slack = record.slack;
        for (std::size_t stage = 0; stage < CycleStageCount; ++stage)
            cycle.stages.append({stageName(stage), record.stages[stage]});
        cycles.append(cycle);
    }
    return cycles;
}

/// For both kinds of public statistics, which call the counters by the same names.
template<typename Statistics>
void CycleStatistics::readCounters(Statistics *statistics) const
{
    statistics->cycles = m_cycles;
    statistics->overruns = m_overruns;
    statistics->skippedCycles = m_skipped;
    statistics->caughtUpCycles = m_caughtUp;
    statistics->shiftedTime = qint64(m_shifted.value());
    statistics->lateAnswers = m_lateAnswers;
    statistics->incompleteCycles = m_incompleteCycles;
    statistics->strangers = m_strangers + keptOff() - m_keptOffBefore;
    statistics->floods = m_floods;
}

QPlcCycleStatistics CycleStatistics::read(QPlcDistribution::Detail detail) const
{
    QPlcCycleStatistics statistics;
    statistics.lateness = m_durations[Lateness].read(newest(), detail);
    statistics.execution = m_durations[Execution].read(newest(), detail);
    statistics.roundTrip = m_durations[RoundTrip].read(newest(), detail);
    statistics.slack = m_durations[Slack].read(newest(), detail);
    readCounters(&statistics);
    statistics.worst = worst();
    return statistics;
}

QPlcMasterStatistics CycleStatistics::summary() const
{
    QPlcMasterStatistics statistics;
    readCounters(&statistics);
    statistics.latenessMedian = m_durations[Lateness].sinceStart().quantile(0.5);
    statistics.lateness99 = m_durations[Lateness].sinceStart().quantile(0.99);
    statistics.latenessMaximum = m_durations[Lateness].sinceStart().maximum();
    statistics.roundTripMedian = m_durations[RoundTrip].sinceStart().quantile(0.5);
    statistics.roundTrip99 = m_durations[RoundTrip].sinceStart().quantile(0.99);
    statistics.roundTripMaximum = m_durations[RoundTrip].sinceStart().maximum();
    return statistics;
}

}  // namespace qplc

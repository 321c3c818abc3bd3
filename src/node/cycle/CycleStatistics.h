// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCycleStatistics.h"
#include "QPlcMasterStatistics.h"
#include "realtime/Counter.h"
#include "realtime/CycleClock.h"
#include "realtime/DurationGroup.h"
#include "realtime/WorstCycles.h"

namespace qplc {

class CyclicHub;

/// What a master measures of its cycles. The cycle thread records, others read at any time.
/// docs/design/statistics.md defines the figures.
///
/// In lockstep only cycles and what the hub counts are counted; all times given are 0.
class CycleStatistics
{
public:
    /// \param hub  that counts frames in the kernel, too; null: none
    explicit CycleStatistics(const CyclicHub *hub = nullptr)
        : m_hub(hub)
    {
    }

    // ---- no cycle runs ----
    /// Begins a phase. \param strangers, floods  counted by the hub so far
    void restart(bool lockstep, std::uint64_t strangers, std::uint64_t floods) noexcept;

    // ---- cycle thread; times in ns on the clock ----
    void begin(const CycleClock::Tick &tick, std::int64_t period) noexcept;
    /// Gives the time since the end of the stage before to \a stage, which may occur more than once
    /// in a cycle.
    void stageEnded(CycleStage stage, std::int64_t now) noexcept
    {
        m_record.stages[std::size_t(stage)] += now - m_stageBegin;
        m_stageBegin = now;
    }
    /// When the stage in progress began.
    std::int64_t stageBegin() const noexcept { return m_stageBegin; }
    void asked() noexcept { m_asked = m_asked == 0 ? m_stageBegin : m_asked; }
    void waited(std::int64_t duration) noexcept { m_waited += duration; }
    /// An answer to the cycle in progress was there.
    void answered(std::int64_t now) noexcept { m_record.roundTrip = now - m_asked; }
    /// An answer to the cycle in progress did not come in its time.
    void lateAnswer() noexcept
    {
        m_lateAnswers.add();
        m_incomplete = true;
    }
    void setArrivals(std::uint64_t strangers, std::uint64_t floods) noexcept
    {
        m_strangers.set(strangers - m_strangersBefore);
        m_floods.set(floods - m_floodsBefore);
    }
    void end(std::int64_t now) noexcept;
    /// Makes the durations that were measured visible to readers; they wait for it for 0.1 s at
    /// most.
    void fold() noexcept { m_durations.fold(); }

    /// Nominal end of the cycle in progress.
    std::int64_t deadline() const noexcept { return m_deadline; }
    /// Execution time of the cycle before [ns].
    std::int64_t workload() const noexcept { return m_workload; }

    // ---- any thread ----
    std::uint64_t cycles() const noexcept { return m_cycles; }
    std::uint64_t overruns() const noexcept { return m_overruns; }
    std::uint64_t skippedCycles() const noexcept { return m_skipped; }
    /// When the newest cycle began [ns].
    std::int64_t newest() const noexcept { return std::int64_t(m_newest.value()); }
    /// All but nodes.
    QPlcCycleStatistics read(QPlcDistribution::Detail detail) const;
    /// All but the digest.
    QPlcMasterStatistics summary() const;

private:
    enum Duration : std::size_t { Lateness, Execution, RoundTrip, Slack, DurationCount };
    using Durations = DurationGroup<DurationCount>;

    std::uint64_t keptOff() const;
    QVector<QPlcWorstCycle> worst() const;
    template<typename Statistics>
    void readCounters(Statistics *statistics) const;

    const CyclicHub *const m_hub;

    // cycle thread
    bool m_lockstep = true;
    std::uint64_t m_strangersBefore = 0;
    std::uint64_t m_floodsBefore = 0;
    CycleRecord m_record;  // of the cycle in progress
    std::int64_t m_overdue = 0;
    std::int64_t m_woken = 0;
    std::int64_t m_deadline = 0;
    std::int64_t m_stageBegin = 0;
    std::int64_t m_asked = 0;
    std::int64_t m_waited = 0;
    std::int64_t m_workload = 0;
    bool m_incomplete = false;

    Counter m_cycles;
    Counter m_overruns;
    Counter m_skipped;
    Counter m_caughtUp;
    Counter m_shifted;
    Counter m_lateAnswers;
    Counter m_incompleteCycles;
    Counter m_strangers;
    Counter m_keptOffBefore;
    Counter m_floods;
    Counter m_newest;
    Durations m_durations;
    WorstCycles m_worst;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSlaveStatistics.h"
#include "realtime/Counter.h"
#include "realtime/DurationGroup.h"

namespace qplc {

/// What a slave measures of its cycles. The cycle thread records, others read at any time. In
/// lockstep nothing is called but restart().
class SlaveStatistics
{
public:
    // ---- no cycle runs ----
    /// \param period  on the clock of the machine [ns]
    void restart(std::int64_t period) noexcept;

    // ---- cycle thread; times in ns on the clock ----
    /// A frame that is to be computed was there at \a arrival, and answered at \a end.
    void answered(std::int64_t arrival, std::int64_t executionTime, std::int64_t end) noexcept;

    /// Makes what was measured visible to readers; they wait for it for 0.1 s at most while frames
    /// come.
    void fold() noexcept { m_durations.fold(); }

    // ---- any thread ----
    QPlcSlaveStatistics read(QPlcDistribution::Detail detail) const;

private:
    enum Duration : std::size_t { Execution, Response, Interval, Slack, DurationCount };
    using Durations = DurationGroup<DurationCount>;

    std::int64_t m_period = 0;
    std::int64_t m_lastArrival = 0;  // 0: none
    Counter m_newest;                // arrival of the newest frame [ns]
    Durations m_durations;
};

}  // namespace qplc

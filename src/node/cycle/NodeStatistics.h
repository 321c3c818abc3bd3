// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeStatistics.h"
#include "realtime/Counter.h"
#include "realtime/DurationGroup.h"

#include <array>

namespace qplc {

/// What the cycle of a master measures of one node. The cycle thread records, others read at any
/// time. 80 KiB.
class NodeStatistics
{
public:
    /// Forgets everything. No cycle runs.
    void clear() noexcept;
    QPlcNodeStatistics read(std::int64_t now, QPlcDistribution::Detail detail) const;

    // ---- cycle thread ----
    // All times are in ns on the clock; all are 0 in lockstep, where only counters are kept.
    /// A request of \a cycle goes out: \a begin of the sending, \a deadline of the answer.
    void asked(std::uint64_t cycle, std::int64_t begin, std::int64_t deadline) noexcept;
    /// A new answer to \a cycle was there at \a arrival.
    void answered(std::uint64_t cycle, std::int64_t arrival, std::int64_t executionTime) noexcept;
    /// A step of a node of this process ended at \a end.
    void stepped(std::int64_t end, std::int64_t executionTime, std::int64_t deadline) noexcept;

    /// Makes what was measured visible to readers; they wait for it for 0.1 s at most.
    void fold() noexcept { m_durations.fold(); }

    Counter answers;
    Counter late;
    Counter lost;
    Counter duplicated;
    Counter reordered;
    Counter rejected;
    Counter forged;
    Counter resent;

private:
    enum Duration : std::size_t { Execution, RoundTrip, Slack, DurationCount };
    using Durations = DurationGroup<DurationCount>;

    struct Request
    {
        std::uint64_t cycle = UINT64_MAX;
        std::uint64_t ordinal = 0;  // among all requests
        std::int64_t begin = 0;
        std::int64_t deadline = 0;
    };
    static constexpr std::size_t Remembered = 32;

    std::array<Request, Remembered> m_requests{};  // at the place cycle % Remembered
    std::uint64_t m_asked = 0;
    std::uint64_t m_settled = 0;   // requests that are answered or lost: those before this ordinal
    std::uint64_t m_unplaced = 0;  // answers since then to requests too old to be remembered
    Durations m_durations;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DurationStatistics.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace qplc {

/// The statistics of several durations that are measured together, again and again. One thread
/// records, folds and clears, others read at any time.
///
/// Histograms are spread over the memory, and a cycle that runs once in a millisecond finds none of
/// it in the caches. So values wait in one place, side by side, until fold() takes them into the
/// histograms in a row; record() does so itself when there is no room left, or when the oldest has
/// waited for LongestWait.
template<std::size_t Durations>
class DurationGroup
{
public:
    static constexpr std::int64_t None = INT64_MIN;           ///< a duration that was not measured this time
    static constexpr std::int64_t LongestWait = 100'000'000;  ///< [ns]
    using Values = std::array<std::int64_t, Durations>;       // [ns]

    /// \param now  when they were measured [ns]
    void record(std::int64_t now, const Values &values) noexcept
    {
        m_waiting[m_count++] = {now, values};
        if (m_count == Room || now - m_waiting[0].time >= LongestWait)
            fold();
    }

    /// Takes the values that wait into the histograms.
    void fold() noexcept
    {
        for (std::size_t duration = 0; duration < Durations; ++duration) {
            for (std::size_t i = 0; i < m_count; ++i) {
                const std::int64_t value = m_waiting[i].values[duration];
                if (value != None)
                    m_statistics[duration].record(value, m_waiting[i].time);
            }
        }
        m_count = 0;
    }

    /// Forgets everything.
    void clear() noexcept
    {
        m_count = 0;
        for (DurationStatistics &statistics : m_statistics)
            statistics.clear();
    }

    /// Of the values that are folded.
    const DurationStatistics &operator[](std::size_t duration) const { return m_statistics[duration]; }

private:
    static constexpr std::size_t Room = 32;
    struct Sample
    {
        std::int64_t time;
        Values values;
    };
    std::size_t m_count = 0;  // recording thread, as those that wait
    std::array<Sample, Room> m_waiting{};
    std::array<DurationStatistics, Durations> m_statistics;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Histogram.h"
#include "QPlcDurationStatistics.h"
#include "SlidingHistogram.h"

namespace qplc {

/// The statistics of one duration since the start and over the last 10 s. One thread records (and
/// clears), others read at any time. 26 KiB.
class DurationStatistics
{
public:
    /// \param value  [ns]; negative values count as 0
    /// \param now  when it was measured [ns]
    void record(std::int64_t value, std::int64_t now) noexcept
    {
        m_sinceStart.record(value);
        m_window.record(value, now);
    }
    void clear() noexcept;

    const Histogram &sinceStart() const { return m_sinceStart; }
    /// \param now  end of the last 10 s [ns]
    QPlcDurationStatistics read(std::int64_t now, QPlcDistribution::Detail detail) const;

private:
    Histogram m_sinceStart;
    SlidingHistogram m_window;
};

}  // namespace qplc

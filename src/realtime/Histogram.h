// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Distributions.h"
#include "LogLinearBins.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace qplc {

/// Distribution of durations in constant memory: log-linear bins, 32 for each power of two, so that
/// a quantile is at most 1/32 above the true value; minimum, maximum, count and sum are exact.
///
/// One thread records (and clears); others may read at any time and see a state that is at most one
/// value old. Recording is allocation-free; 15 KiB.
class Histogram
{
public:
    /// \param value  [ns]; negative values count as 0
    void record(std::int64_t value) noexcept;
    /// Forgets everything. Recording thread only; a reader may see a part of the old values
    /// meanwhile.
    void clear() noexcept;

    std::uint64_t count() const noexcept { return m_count.load(std::memory_order_acquire); }
    std::int64_t minimum() const noexcept;  ///< 0 when empty
    std::int64_t maximum() const noexcept { return m_maximum.load(std::memory_order_relaxed); }
    double mean() const noexcept;  ///< 0 when empty
    /// Smallest bin border that at least the fraction \a q (0 ... 1) of all values, and at least
    /// one, do not exceed; never above maximum(). 0 when empty.
    std::int64_t quantile(double q) const;
    /// All figures, of one moment, with bins.
    QPlcDistribution distribution() const;

private:
    using Bins = LogLinearBins<5, 63>;
    QVector<QPlcDistribution::Bin> filledBins() const;

    std::array<std::atomic<std::uint64_t>, Bins::Count> m_bins{};  // 32 bits would be full after five days at 10 kHz
    std::atomic<std::uint64_t> m_count{0};
    std::atomic<std::int64_t> m_sum{0};
    std::atomic<std::int64_t> m_minimum{INT64_MAX};
    std::atomic<std::int64_t> m_maximum{0};
};

}  // namespace qplc

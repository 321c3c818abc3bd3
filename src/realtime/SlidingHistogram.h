// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Distributions.h"
#include "LogLinearBins.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace qplc {

/// Distribution of the durations of the last 10 s in constant memory: a ring of ten histograms of
/// one second each.
///
/// A quantile is at most 1/8 above the true value; minimum, maximum, count and mean are exact. One
/// thread records (and clears); others read at any time and never hold it up: a reader that meets
/// the begin of a new second reads again. Recording is allocation-free; 11 KiB.
class SlidingHistogram
{
public:
    static constexpr int Seconds = 10;

    /// \param value  [ns]; negative values count as 0
    /// \param now  when it was measured [ns], not before the value recorded last
    void record(std::int64_t value, std::int64_t now) noexcept;
    /// Forgets everything. Recording thread only.
    void clear() noexcept;
    /// The values recorded in the second in which \a now [ns] lies, and in the nine seconds before
    /// it; with bins.
    QPlcDistribution distribution(std::int64_t now) const;

private:
    using Bins = LogLinearBins<3, 36>;  // up to 69 s

    struct Slice
    {
        std::atomic<std::int64_t> second{-1};  // that it holds; -1: none
        std::array<std::atomic<std::uint32_t>, Bins::Count> bins{};
        std::atomic<std::int64_t> sum{0};
        std::atomic<std::int64_t> minimum{INT64_MAX};
        std::atomic<std::int64_t> maximum{0};
        int firstBin = Bins::Count;  // recording thread: what has to be cleared
        int lastBin = -1;

        void record(std::int64_t value) noexcept;
        void clear() noexcept;
    };
    struct Sum
    {
        std::array<std::uint64_t, Bins::Count> bins{};
        ExactFigures exact;
    };

    void beginSecond(std::int64_t second) noexcept;
    bool sumUp(std::int64_t second, Sum *sum) const noexcept;

    std::array<Slice, Seconds> m_slices;
    Slice *m_current = &m_slices[0];          // recording thread
    std::atomic<std::uint64_t> m_version{0};  // odd while a slice is being cleared
};

}  // namespace qplc

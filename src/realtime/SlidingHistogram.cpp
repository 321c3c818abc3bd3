// SPDX-License-Identifier: Apache-2.0
#include "SlidingHistogram.h"

#include "TimeSource.h"

#include <algorithm>
#include <thread>

namespace qplc {

namespace {

std::int64_t secondOf(std::int64_t now) noexcept
{
    return std::max<std::int64_t>(now, 0) / NanosecondsPerSecond;  // before the clock began is its first second
}

}  // namespace

void SlidingHistogram::Slice::record(std::int64_t value) noexcept
{
    if (value < minimum.load(std::memory_order_relaxed))
        minimum.store(value, std::memory_order_relaxed);
    if (value > maximum.load(std::memory_order_relaxed))
        maximum.store(value, std::memory_order_relaxed);
    sum.store(ExactFigures::sumOf(sum.load(std::memory_order_relaxed), value), std::memory_order_relaxed);
    const int bin = Bins::binOf(std::uint64_t(value));
    firstBin = std::min(firstBin, bin);
    lastBin = std::max(lastBin, bin);
    std::atomic<std::uint32_t> &counter = bins[std::size_t(bin)];
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

void SlidingHistogram::Slice::clear() noexcept
{
    // Released: a reader that sees anything of this sees that the version has changed, too.
    for (int bin = firstBin; bin <= lastBin; ++bin)
        bins[std::size_t(bin)].store(0, std::memory_order_release);
    sum.store(0, std::memory_order_release);
    minimum.store(INT64_MAX, std::memory_order_release);
    maximum.store(0, std::memory_order_release);
    firstBin = Bins::Count;
    lastBin = -1;
}

void SlidingHistogram::record(std::int64_t value, std::int64_t now) noexcept
{
    const std::int64_t second = secondOf(now);
    if (m_current->second.load(std::memory_order_relaxed) != second)
        beginSecond(second);
    m_current->record(std::max<std::int64_t>(value, 0));
}

void SlidingHistogram::beginSecond(std::int64_t second) noexcept
{
    const std::uint64_t version = m_version.load(std::memory_order_relaxed);
    m_version.store(version + 1, std::memory_order_relaxed);
    m_current = &m_slices[std::size_t(second % Seconds)];
    m_current->clear();
    m_current->second.store(second, std::memory_order_release);
    m_version.store(version + 2, std::memory_order_release);
}

void SlidingHistogram::clear() noexcept
{
    const std::uint64_t version = m_version.load(std::memory_order_relaxed);
    m_version.store(version + 1, std::memory_order_relaxed);
    for (Slice &slice : m_slices) {
        slice.clear();
        slice.second.store(-1, std::memory_order_release);
    }
    m_version.store(version + 2, std::memory_order_release);
}

/// \return false when a second began meanwhile
bool SlidingHistogram::sumUp(std::int64_t second, Sum *sum) const noexcept
{
    const std::uint64_t version = m_version.load(std::memory_order_acquire);
    *sum = Sum();
    for (const Slice &slice : m_slices) {
        const std::int64_t its = slice.second.load(std::memory_order_acquire);
        if (its < 0 || its > second || its <= second - Seconds)
            continue;
        const int last = Bins::binOf(std::uint64_t(slice.maximum.load(std::memory_order_acquire)));
        const int first = Bins::binOf(std::uint64_t(slice.minimum.load(std::memory_order_acquire)));
        // Bins before the extremes: who sees a value counted sees it in the extremes, too.
        for (auto bin = std::size_t(first); bin <= std::size_t(last); ++bin)
            sum->bins[bin] += slice.bins[bin].load(std::memory_order_acquire);
        sum->exact.add({slice.minimum.load(std::memory_order_acquire), slice.maximum.load(std::memory_order_acquire),
                        slice.sum.load(std::memory_order_acquire)});
    }
    return version % 2 == 0 && m_version.load(std::memory_order_relaxed) == version;
}

QPlcDistribution SlidingHistogram::distribution(std::int64_t now) const
{
    Sum sum;
    while (!sumUp(secondOf(now), &sum))
        std::this_thread::yield();  // the recorder may be waiting for this processor
    QVector<QPlcDistribution::Bin> bins;
    for (int bin = 0; bin < Bins::Count; ++bin) {
        if (sum.bins[std::size_t(bin)] > 0)
            bins.append({Bins::upperBorder(bin), sum.bins[std::size_t(bin)]});
    }
    return distributionOf(bins, sum.exact);
}

}  // namespace qplc

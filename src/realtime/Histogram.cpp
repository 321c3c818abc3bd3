// SPDX-License-Identifier: Apache-2.0
#include "Histogram.h"

#include <algorithm>

namespace qplc {

namespace {

// Only one thread writes: a load and a store are enough, and several times faster than a locked
// increment.
template<typename T>
void raise(std::atomic<T> &counter, std::memory_order order) noexcept
{
    counter.store(counter.load(std::memory_order_relaxed) + 1, order);
}

}  // namespace

void Histogram::record(std::int64_t value) noexcept
{
    value = std::max<std::int64_t>(value, 0);
    if (value < m_minimum.load(std::memory_order_relaxed))
        m_minimum.store(value, std::memory_order_relaxed);
    if (value > m_maximum.load(std::memory_order_relaxed))
        m_maximum.store(value, std::memory_order_relaxed);
    m_sum.store(ExactFigures::sumOf(m_sum.load(std::memory_order_relaxed), value), std::memory_order_relaxed);

    // Released last: who sees the value counted sees it in the extremes, too.
    raise(m_bins[std::size_t(Bins::binOf(std::uint64_t(value)))], std::memory_order_release);
    raise(m_count, std::memory_order_release);
}

void Histogram::clear() noexcept
{
    m_count.store(0, std::memory_order_relaxed);
    for (auto &bin : m_bins)
        bin.store(0, std::memory_order_relaxed);
    m_sum.store(0, std::memory_order_relaxed);
    m_minimum.store(INT64_MAX, std::memory_order_relaxed);
    m_maximum.store(0, std::memory_order_relaxed);
}

std::int64_t Histogram::minimum() const noexcept
{
    return count() > 0 ? m_minimum.load(std::memory_order_relaxed) : 0;
}

double Histogram::mean() const noexcept
{
    const std::uint64_t values = count();
    return values > 0 ? double(m_sum.load(std::memory_order_relaxed)) / double(values) : 0.0;
}

/// A copy, because recording goes on meanwhile.
QVector<QPlcDistribution::Bin> Histogram::filledBins() const
{
    QVector<QPlcDistribution::Bin> bins;
    const int last = Bins::binOf(std::uint64_t(maximum()));
    for (int bin = Bins::binOf(std::uint64_t(m_minimum.load(std::memory_order_relaxed))); bin <= last; ++bin) {
        if (const std::uint64_t values = m_bins[std::size_t(bin)].load(std::memory_order_acquire))
            bins.append({Bins::upperBorder(bin), values});
    }
    return bins;
}

std::int64_t Histogram::quantile(double q) const
{
    const QVector<QPlcDistribution::Bin> bins = filledBins();
    return quantileOf(bins, q, maximum());
}

QPlcDistribution Histogram::distribution() const
{
    const QVector<QPlcDistribution::Bin> bins = filledBins();
    return distributionOf(
        bins, {m_minimum.load(std::memory_order_relaxed), maximum(), m_sum.load(std::memory_order_relaxed)});
}

}  // namespace qplc

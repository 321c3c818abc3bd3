// SPDX-License-Identifier: Apache-2.0
#include "Histogram.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

// Only one thread writes: a load and a store are enough, and several times faster than a locked increment.
template<typename T>
void raise(std::atomic<T> &counter, std::memory_order order) noexcept
{
    counter.store(counter.load(std::memory_order_relaxed) + 1, order);
}

}  // namespace

// Values below 2^SubBits have a bin each. Above, the bins of the powers of two follow each other: the leading bit
// selects the group, the SubBits bits behind it the bin within the group.
int Histogram::binOf(std::uint64_t value) noexcept
{
    if (value >> SubBits == 0)
        return int(value);
    const int shift = 63 - __builtin_clzll(value) - SubBits;
    return ((shift + 1) << SubBits) + int((value >> shift) & ((1U << SubBits) - 1));
}

std::uint64_t Histogram::upperBorder(int bin) noexcept
{
    const int group = bin >> SubBits;
    if (group == 0)
        return std::uint64_t(bin);
    const int shift = group - 1;
    constexpr std::uint64_t leading = std::uint64_t(1) << SubBits;
    const std::uint64_t rest = std::uint64_t(bin) & (leading - 1);
    return ((leading + rest + 1) << shift) - 1;
}

void Histogram::record(std::int64_t value) noexcept
{
    value = std::max<std::int64_t>(value, 0);
    if (value < m_minimum.load(std::memory_order_relaxed))
        m_minimum.store(value, std::memory_order_relaxed);
    if (value > m_maximum.load(std::memory_order_relaxed))
        m_maximum.store(value, std::memory_order_relaxed);

    std::int64_t sum = 0;
    if (__builtin_add_overflow(m_sum.load(std::memory_order_relaxed), value, &sum))
        sum = INT64_MAX;  // 292 years
    m_sum.store(sum, std::memory_order_relaxed);

    // Released last: who sees the value counted sees it in the extremes, too.
    raise(m_bins[std::size_t(binOf(std::uint64_t(value)))], std::memory_order_release);
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

std::int64_t Histogram::quantile(double q) const noexcept
{
    std::array<std::uint64_t, BinCount> bins;  // a copy, because recording goes on meanwhile
    std::uint64_t total = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin)
        total += bins[bin] = m_bins[bin].load(std::memory_order_acquire);
    if (total == 0)
        return 0;

    const double fraction = q > 0.0 ? std::min(q, 1.0) : 0.0;  // a NaN counts as 0
    const auto rank = std::clamp<std::uint64_t>(std::uint64_t(std::ceil(fraction * double(total))), 1, total);
    std::size_t bin = 0;
    for (std::uint64_t reached = bins[0]; reached < rank; reached += bins[bin])
        ++bin;
    return std::min(std::int64_t(upperBorder(int(bin))), maximum());
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "Distributions.h"

#include <cmath>

namespace qplc {

namespace {

std::uint64_t totalOf(const QVector<QPlcDistribution::Bin> &bins)
{
    std::uint64_t total = 0;
    for (const QPlcDistribution::Bin &bin : bins)
        total += bin.count;
    return total;
}

}  // namespace

std::int64_t quantileOf(const QVector<QPlcDistribution::Bin> &bins, double q, std::int64_t maximum)
{
    if (bins.isEmpty())
        return 0;
    const std::uint64_t total = totalOf(bins);
    const double fraction = q > 0.0 ? std::min(q, 1.0) : 0.0;  // a NaN counts as 0
    const auto rank = std::clamp<std::uint64_t>(std::uint64_t(std::ceil(fraction * double(total))), 1, total);
    auto bin = bins.begin();
    for (std::uint64_t reached = bin->count; reached < rank; reached += bin->count)
        ++bin;
    return std::min<std::int64_t>(bin->upperBorder, maximum);
}

QPlcDistribution distributionOf(const QVector<QPlcDistribution::Bin> &bins, const ExactFigures &exact)
{
    QPlcDistribution distribution;
    distribution.count = totalOf(bins);
    if (distribution.count == 0)
        return distribution;
    distribution.minimum = exact.minimum;
    // Values that were recorded while the bins were being read may be in the sum alone.
    distribution.mean
        = std::clamp(double(exact.sum) / double(distribution.count), double(exact.minimum), double(exact.maximum));
    distribution.p001 = quantileOf(bins, 0.001, exact.maximum);
    distribution.p01 = quantileOf(bins, 0.01, exact.maximum);
    distribution.p50 = quantileOf(bins, 0.5, exact.maximum);
    distribution.p99 = quantileOf(bins, 0.99, exact.maximum);
    distribution.p999 = quantileOf(bins, 0.999, exact.maximum);
    distribution.maximum = exact.maximum;
    distribution.bins = bins;
    return distribution;
}

}  // namespace qplc

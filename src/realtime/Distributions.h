// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDistribution.h"

#include <algorithm>
#include <cstdint>

namespace qplc {

/// What is known of values exactly, beside their bins.
struct ExactFigures
{
    std::int64_t minimum = INT64_MAX;
    std::int64_t maximum = 0;
    std::int64_t sum = 0;

    /// Adds without running over: 292 years are enough.
    static std::int64_t sumOf(std::int64_t a, std::int64_t b) noexcept
    {
        std::int64_t sum = 0;
        return __builtin_add_overflow(a, b, &sum) ? INT64_MAX : sum;
    }
    void add(const ExactFigures &other) noexcept
    {
        minimum = std::min(minimum, other.minimum);
        maximum = std::max(maximum, other.maximum);
        sum = sumOf(sum, other.sum);
    }
};

/// Smallest border of \a bins that at least the fraction \a q (0 ... 1) of all values, and at least
/// one, do not exceed; never above \a maximum.
std::int64_t quantileOf(const QVector<QPlcDistribution::Bin> &bins, double q, std::int64_t maximum);
/// The distribution of the values in \a bins (rising, none empty), which it keeps.
QPlcDistribution distributionOf(const QVector<QPlcDistribution::Bin> &bins, const ExactFigures &exact);

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace qplc {

/// The time between two cycles that a master may have, and that a node accepts.
constexpr std::chrono::nanoseconds ShortestPeriod = std::chrono::microseconds(10);
constexpr std::chrono::nanoseconds LongestPeriod = std::chrono::seconds(10);

/// So many cycles of a phase have a time that can be told in nanoseconds.
constexpr std::uint64_t mostCycles(std::chrono::nanoseconds period)
{
    return std::uint64_t(std::numeric_limits<std::int64_t>::max() / period.count());
}

/// Not set: \a seconds are not a number, or more than a duration can hold (292 years).
inline std::optional<std::chrono::nanoseconds> nanosecondsOf(double seconds)
{
    if (!(std::abs(seconds) < 9.2e9))
        return {};
    return std::chrono::nanoseconds(std::llround(seconds * 1e9));
}

}  // namespace qplc

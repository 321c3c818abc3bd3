// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// The only place where the library looks at a clock. Tests give a fake one.
class TimeSource
{
public:
    virtual ~TimeSource() = default;
    /// Time of a clock that never steps [ns].
    virtual std::int64_t now() noexcept = 0;
    /// Sleeps until now() >= \a deadline. \return false when it was interrupted before
    virtual bool sleepUntil(std::int64_t deadline) noexcept = 0;

    /// CLOCK_MONOTONIC.
    static TimeSource &monotonic();
};

/// The wall clock, for stamps only, never for control [ns since 1970-01-01 UTC].
std::int64_t wallClockNow() noexcept;

}  // namespace qplc

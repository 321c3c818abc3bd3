// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>

namespace qplc {

/// A clock that the library looks at. Tests give a fake one.
class TimeSource
{
public:
    virtual ~TimeSource() = default;
    /// Time of a clock that never steps [ns].
    virtual std::int64_t now() noexcept = 0;
    /// How long the computer has slept since it was switched on [ns]: now() stood still meanwhile.
    virtual std::int64_t slept() noexcept { return 0; }
    /// Sleeps until now() >= \a deadline. \return false when it was interrupted before
    virtual bool sleepUntil(std::int64_t deadline) noexcept = 0;
    /// A descriptor that is readable from \a deadline on, until the next call of alarm() or
    /// sleepUntil(); for a poll() that waits for other things, too.
    /// \return -1 when this clock has none
    virtual int alarm(std::int64_t /*deadline*/) noexcept { return -1; }

    /// The clock of Host::current() that never steps: CLOCK_MONOTONIC on the machine.
    static TimeSource &monotonic();
};

constexpr std::int64_t NanosecondsPerSecond = 1'000'000'000;

/// Time of the clock of TimeSource::monotonic() [ns].
inline std::int64_t monotonicNow() noexcept
{
    return TimeSource::monotonic().now();
}

/// \a time [ns], >= 0, as the kernel takes it.
timespec timeSpec(std::int64_t time) noexcept;

/// The wall clock of Host::current(), for stamps only, never for control [ns since 1970-01-01 UTC].
std::int64_t wallClockNow() noexcept;

}  // namespace qplc

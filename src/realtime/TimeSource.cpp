// SPDX-License-Identifier: Apache-2.0
#include "TimeSource.h"

#include <algorithm>
#include <ctime>

namespace qplc {

namespace {

std::int64_t readClock(clockid_t clock) noexcept
{
    timespec time{};
    clock_gettime(clock, &time);
    return std::int64_t(time.tv_sec) * NanosecondsPerSecond + time.tv_nsec;
}

class MonotonicTime final : public TimeSource
{
public:
    std::int64_t now() noexcept override { return readClock(CLOCK_MONOTONIC); }
    std::int64_t slept() noexcept override { return -readClock(CLOCK_MONOTONIC) + readClock(CLOCK_BOOTTIME); }
    bool sleepUntil(std::int64_t deadline) noexcept override
    {
        const std::int64_t instant = std::max<std::int64_t>(deadline, 0);  // an instant before 0 is no valid timespec
        const timespec time = timeSpec(instant);
        // The error is the returned value: errno stays as it was.
        return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == 0;
    }
};

}  // namespace

TimeSource &TimeSource::monotonic()
{
    static MonotonicTime time;
    return time;
}

timespec timeSpec(std::int64_t time) noexcept
{
    return {time_t(time / NanosecondsPerSecond), decltype(timespec::tv_nsec)(time % NanosecondsPerSecond)};
}

std::int64_t wallClockNow() noexcept
{
    return readClock(CLOCK_REALTIME);
}

}  // namespace qplc

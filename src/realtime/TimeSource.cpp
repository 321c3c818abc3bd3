// SPDX-License-Identifier: Apache-2.0
#include "TimeSource.h"

#include "Host.h"

namespace qplc {

namespace {

class MonotonicTime final : public TimeSource
{
public:
    std::int64_t now() noexcept override { return Host::current().now(); }
    std::int64_t slept() noexcept override { return Host::current().slept(); }
    bool sleepUntil(std::int64_t deadline) noexcept override { return Host::current().sleepUntil(deadline); }
};

}  // namespace

TimeSource &TimeSource::monotonic()
{
    static MonotonicTime &time = *new MonotonicTime;  // for ever: threads that end with the program use it, too
    return time;
}

timespec timeSpec(std::int64_t time) noexcept
{
    return {time_t(time / NanosecondsPerSecond), decltype(timespec::tv_nsec)(time % NanosecondsPerSecond)};
}

std::int64_t wallClockNow() noexcept
{
    return Host::current().wallClock();
}

}  // namespace qplc

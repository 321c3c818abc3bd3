// SPDX-License-Identifier: Apache-2.0
#include "Machine.h"

#include "TimeSource.h"

#include <QtCore/QRandomGenerator>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <sys/eventfd.h>
#include <unistd.h>

namespace qplc {

namespace {

std::int64_t readClock(clockid_t clock) noexcept
{
    timespec time{};
    clock_gettime(clock, &time);
    return std::int64_t(time.tv_sec) * NanosecondsPerSecond + time.tv_nsec;
}

}  // namespace

std::int64_t Machine::now() noexcept
{
    return readClock(CLOCK_MONOTONIC);
}

std::int64_t Machine::slept() noexcept
{
    return -readClock(CLOCK_MONOTONIC) + readClock(CLOCK_BOOTTIME);
}

bool Machine::sleepUntil(std::int64_t deadline) noexcept
{
    const std::int64_t instant = std::max<std::int64_t>(deadline, 0);  // an instant before 0 is no valid timespec
    const timespec time = timeSpec(instant);
    // The error is the returned value: errno stays as it was.
    return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == 0;
}

std::int64_t Machine::wallClock() noexcept
{
    return readClock(CLOCK_REALTIME);
}

std::uint64_t Machine::random()
{
    return QRandomGenerator::system()->generate64();
}

int Machine::openWakeUp(int *error) noexcept
{
    const int descriptor = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    *error = descriptor < 0 ? errno : 0;
    return descriptor;
}

void Machine::closeWakeUp(int descriptor) noexcept
{
    close(descriptor);
}

void Machine::wake(int descriptor) noexcept
{
    const std::uint64_t once = 1;
    // Fails only when the counter is full (2^64 - 2), and then the descriptor is readable anyway.
    [[maybe_unused]] const ssize_t written = write(descriptor, &once, sizeof once);
}

bool Machine::consumeWakeUp(int descriptor) noexcept
{
    std::uint64_t times = 0;
    return read(descriptor, &times, sizeof times) == ssize_t(sizeof times);
}

}  // namespace qplc

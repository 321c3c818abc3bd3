// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TimeSource.h"

namespace qplc {

class Host;

/// CLOCK_MONOTONIC with one timer of the kernel for everything that a cycle waits for: the sleep
/// until its begin, and the end of the time for answers.
///
/// A wait with a time limit of its own starts a timer and stops it again. That is a write to the
/// timer of the processor each time, which a virtual machine hands to its host: 20 us were seen, in
/// each cycle. This timer runs on from alarm to alarm by itself, as long as they are a period
/// apart.
///
/// Used by one thread. Where no timer can be had, sleeps are those of its host, and there is no
/// alarm.
class AlarmTime final : public TimeSource
{
public:
    AlarmTime();
    ~AlarmTime() override;
    AlarmTime(const AlarmTime &) = delete;
    AlarmTime &operator=(const AlarmTime &) = delete;

    /// The usual distance of two alarms [ns]; 0: there is none.
    void setPeriod(std::int64_t period) noexcept;

    std::int64_t now() noexcept override;
    std::int64_t slept() noexcept override;
    bool sleepUntil(std::int64_t deadline) noexcept override;
    int alarm(std::int64_t deadline) noexcept override;

private:
    static constexpr std::int64_t Never = INT64_MIN;

    Host &m_host;  // on which it was made
    int m_timer = -1;
    std::int64_t m_period = 0;
    std::int64_t m_next = Never;  // when the timer rings, or has rung without having been read
};

}  // namespace qplc

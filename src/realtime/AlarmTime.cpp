// SPDX-License-Identifier: Apache-2.0
#include "AlarmTime.h"

#include "Host.h"

#include <algorithm>
#include <sys/timerfd.h>
#include <unistd.h>

namespace qplc {

AlarmTime::AlarmTime()
    : m_host(Host::current())
    , m_timer(m_host.hasKernelTimers() ? ::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC) : -1)
{
}

AlarmTime::~AlarmTime()
{
    if (m_timer >= 0)
        ::close(m_timer);
}

void AlarmTime::setPeriod(std::int64_t period) noexcept
{
    m_period = period;
    m_next = Never;
}

std::int64_t AlarmTime::now() noexcept
{
    return m_host.now();
}

int AlarmTime::alarm(std::int64_t deadline) noexcept
{
    const std::int64_t instant = std::max<std::int64_t>(deadline, 1);  // 0 would stop the timer
    if (m_timer < 0 || m_next == instant)
        return m_timer;
    const itimerspec setting{timeSpec(m_period), timeSpec(instant)};
    m_next = ::timerfd_settime(m_timer, TFD_TIMER_ABSTIME, &setting, nullptr) == 0 ? instant : Never;
    return m_next == instant ? m_timer : -1;
}

std::int64_t AlarmTime::slept() noexcept
{
    return m_host.slept();
}

bool AlarmTime::sleepUntil(std::int64_t deadline) noexcept
{
    const int timer = alarm(deadline);
    if (timer < 0)
        return m_host.sleepUntil(deadline);
    std::uint64_t rung = 0;
    if (::read(timer, &rung, sizeof rung) != sizeof rung)
        return false;
    m_next = m_period > 0 ? m_next + std::int64_t(rung) * m_period : Never;
    return true;
}

}  // namespace qplc

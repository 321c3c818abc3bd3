// SPDX-License-Identifier: Apache-2.0
#include "ReferenceClock.h"

#include <algorithm>
#include <ctime>
#include <sched.h>

namespace soak {

ReferenceClock::ReferenceClock(HistoryWriter &history, qint64 tolerance)
    : m_history(history)
    , m_tolerance(tolerance)
{
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    ::sched_getaffinity(0, sizeof allowed, &allowed);
    for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
        if (CPU_ISSET(processor, &allowed))
            m_threads.emplace_back([this, processor] { run(processor); });
    }
}

ReferenceClock::~ReferenceClock()
{
    m_stop = true;
    for (std::thread &thread : m_threads)
        thread.join();
}

void ReferenceClock::run(int processor) noexcept
{
    cpu_set_t mine;
    CPU_ZERO(&mine);
    CPU_SET(processor, &mine);
    ::sched_setaffinity(0, sizeof mine, &mine);
    const qint64 step = std::max<qint64>(500'000, m_tolerance / 2);
    qint64 next = monotonicNow() + step;
    while (!m_stop) {
        const timespec deadline{time_t(next / 1'000'000'000), long(next % 1'000'000'000)};
        ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
        const qint64 now = monotonicNow();
        if (now - next > m_tolerance)
            m_history.append(Record::Stall, -1, {quint64(next), quint64(processor)});
        next = std::max(next + step, now);
    }
}

}  // namespace soak

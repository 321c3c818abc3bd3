// SPDX-License-Identifier: Apache-2.0
#include "InterruptibleWaits.h"

#include "Host.h"
#include "TimeSource.h"

#include <algorithm>
#include <csignal>
#include <mutex>
#include <sys/syscall.h>
#include <unistd.h>

namespace qplc {

namespace {

void doNothing(int) {}

/// An ignored signal interrupts nothing: it needs a handler.
void installHandler()
{
    struct sigaction present = {};
    ::sigaction(SIGURG, nullptr, &present);
    if (present.sa_handler != SIG_DFL && present.sa_handler != SIG_IGN)
        return;
    struct sigaction action = {};
    action.sa_handler = &doNothing;  // without SA_RESTART
    ::sigaction(SIGURG, &action, nullptr);
}

void unblock()
{
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGURG);
    ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

InterruptibleWaits::InterruptibleWaits(std::int64_t period)
    : m_strand(Host::current().runningStrand())
{
    if (!m_strand) {
        static std::once_flag once;
        std::call_once(once, &installHandler);
        unblock();
        sigevent event{};
        event.sigev_notify = SIGEV_THREAD_ID;
        event.sigev_signo = SIGURG;
        event._sigev_un._tid = pid_t(::syscall(SYS_gettid));
        m_exists = ::timer_create(CLOCK_MONOTONIC, &event, &m_timer) == 0;
    }
    if (period > 0)
        interruptAt(monotonicNow() + period, period);
}

void InterruptibleWaits::interruptAt(std::int64_t instant, std::int64_t period) noexcept
{
    if (m_strand)
        m_strand->interruptAt(instant, period);
    const itimerspec times{timeSpec(period), timeSpec(std::max<std::int64_t>(instant, 1))};  // 0 would stop it
    if (m_exists)
        ::timer_settime(m_timer, TIMER_ABSTIME, &times, nullptr);
}

InterruptibleWaits::~InterruptibleWaits()
{
    if (m_exists)
        ::timer_delete(m_timer);
}

void InterruptibleWaits::interrupt(pthread_t thread) noexcept
{
    ::pthread_kill(thread, SIGURG);
}

}  // namespace qplc

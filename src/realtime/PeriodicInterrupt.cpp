// SPDX-License-Identifier: Apache-2.0
#include "PeriodicInterrupt.h"

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

PeriodicInterrupt::PeriodicInterrupt(std::int64_t period)
{
    static std::once_flag once;
    std::call_once(once, &installHandler);
    unblock();
    sigevent event{};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = SIGURG;
    event._sigev_un._tid = pid_t(::syscall(SYS_gettid));
    m_exists = ::timer_create(CLOCK_MONOTONIC, &event, &m_timer) == 0;
    if (!m_exists)
        return;
    constexpr std::int64_t second = 1'000'000'000;
    const timespec interval{time_t(period / second), long(period % second)};
    const itimerspec times{interval, interval};
    ::timer_settime(m_timer, 0, &times, nullptr);
}

PeriodicInterrupt::~PeriodicInterrupt()
{
    if (m_exists)
        ::timer_delete(m_timer);
}

}  // namespace qplc

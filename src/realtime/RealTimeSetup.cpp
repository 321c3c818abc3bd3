// SPDX-License-Identifier: Apache-2.0
#include "RealTimeSetup.h"

#include "CycleThread.h"
#include "HeapReserve.h"
#include "Remedies.h"
#include "StackPrefault.h"

#include <cerrno>
#include <fstream>
#include <sched.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>

#ifndef SCHED_RESET_ON_FORK
#define SCHED_RESET_ON_FORK 0x40000000
#endif

namespace qplc {

namespace {

QPlcRealTimeSetting setting(const char *name, const QString &wanted)
{
    QPlcRealTimeSetting result;
    result.name = QLatin1String(name);
    result.wanted = wanted;
    return result;
}

Scheduling wantedScheduling(const QPlcRealTimeOptions &options, Scheduling inherited)
{
    switch (options.policy) {
    case QPlcRealTimeOptions::Other:
        return {SCHED_OTHER, 0};
    case QPlcRealTimeOptions::Fifo:
        return {SCHED_FIFO, options.priority};
    case QPlcRealTimeOptions::RoundRobin:
        return {SCHED_RR, options.priority};
    case QPlcRealTimeOptions::Inherit:
        break;
    }
    return inherited;
}

int setScheduling(Scheduling wanted)
{
    sched_param parameters{};
    parameters.sched_priority = wanted.priority;
    return pthread_setschedparam(pthread_self(), wanted.policy, &parameters);
}

QPlcRealTimeSetting applyScheduling(const QPlcRealTimeOptions &options, Scheduling inherited)
{
    const Scheduling wanted = wantedScheduling(options, inherited);
    const bool inherits = options.policy == QPlcRealTimeOptions::Inherit;
    QPlcRealTimeSetting result
        = setting("scheduling", wanted.toString() + QLatin1String(inherits ? " (inherited)" : ""));
    const int error = inherits ? 0 : setScheduling(wanted);
    const Scheduling obtained = Scheduling::current();
    result.obtained = obtained.toString();
    result.granted = obtained == wanted;
    if (!result.granted)
        result.remedy = inherits ? inheritanceRemedy() : schedulingRemedy(wanted, error);
    return result;
}

/// The processors that the calling thread may use: "0-3,6".
QString allowedCpus()
{
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    QStringList ranges;
    for (int first = 0; first < CPU_SETSIZE; ++first) {
        if (!CPU_ISSET(first, &set))
            continue;
        int last = first;
        while (last + 1 < CPU_SETSIZE && CPU_ISSET(last + 1, &set))
            ++last;
        ranges += last > first ? QStringLiteral("%1-%2").arg(first).arg(last) : QString::number(first);
        first = last;
    }
    return ranges.join(QLatin1Char(','));
}

QPlcRealTimeSetting applyCpu(int cpu)
{
    QPlcRealTimeSetting result = setting("cpu", QString::number(cpu));
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(cpu, &set);
    sched_setaffinity(0, sizeof set, &set);
    result.obtained = allowedCpus();
    result.granted = result.obtained == result.wanted;
    if (!result.granted)
        result.remedy = cpuRemedy(result.obtained);
    return result;
}

/// [KiB] VmLck of this process; 0 when nothing is locked or nobody tells.
qint64 lockedMemory()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        if (word == "VmLck:") {
            qint64 size = 0;
            status >> size;
            return size;
        }
    }
    return 0;
}

QPlcRealTimeSetting applyMemoryLock()
{
    QPlcRealTimeSetting result = setting("locked memory", QStringLiteral("all"));
    const int error = mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 0 : errno;
    const qint64 locked = lockedMemory();
    result.granted = error == 0 && locked > 0;
    result.obtained
        = result.granted ? QStringLiteral("all (%1 KiB)").arg(locked) : QStringLiteral("%1 KiB").arg(locked);
    if (!result.granted)
        result.remedy = memoryLockRemedy(error);
    return result;
}

QPlcRealTimeSetting applyPrefault(int size)
{
    QPlcRealTimeSetting result = setting("stack", QStringLiteral("%1 byte").arg(size));
    const qint64 resident = prefaultStack(size);
    result.obtained = QStringLiteral("%1 byte").arg(resident);
    result.granted = resident >= size;
    if (!result.granted)
        result.remedy = stackRemedy();
    return result;
}

QPlcRealTimeSetting applyTimerSlack(qint64 slack)
{
    QPlcRealTimeSetting result = setting("timer slack", QStringLiteral("%1 ns").arg(slack));
    prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(slack), 0UL, 0UL, 0UL);
    if (Scheduling::current().isRealTime()) {
        result.obtained = QStringLiteral("none (real-time thread)");
        result.granted = true;
        return result;
    }
    const int obtained = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL);
    result.obtained = QStringLiteral("%1 ns").arg(obtained);
    result.granted = obtained == slack;
    if (!result.granted)
        result.remedy = timerSlackRemedy();
    return result;
}

}  // namespace

Scheduling Scheduling::current()
{
    Scheduling result;
    result.policy = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
    sched_param parameters{};
    sched_getparam(0, &parameters);
    result.priority = parameters.sched_priority;
    return result;
}

bool Scheduling::isRealTime() const
{
    return policy == SCHED_FIFO || policy == SCHED_RR || policy == SCHED_DEADLINE;
}

QString Scheduling::toString() const
{
    struct Name
    {
        int policy;
        const char *text;
    };
    constexpr Name names[]
        = {{SCHED_OTHER, "SCHED_OTHER"}, {SCHED_FIFO, "SCHED_FIFO"}, {SCHED_RR, "SCHED_RR"},
           {SCHED_BATCH, "SCHED_BATCH"}, {SCHED_IDLE, "SCHED_IDLE"}, {SCHED_DEADLINE, "SCHED_DEADLINE"}};
    for (const Name &name : names) {
        if (name.policy == policy)
            return QStringLiteral("%1 %2").arg(QLatin1String(name.text)).arg(priority);
    }
    return QStringLiteral("policy %1, priority %2").arg(policy).arg(priority);
}

QVector<QPlcRealTimeSetting> applyHeapOptions(const QPlcRealTimeOptions &options)
{
    if (!options.lockMemory || options.heapReserve == 0)
        return {};
    QPlcRealTimeSetting result = setting("heap", QStringLiteral("%1 byte").arg(options.heapReserve));
    const std::size_t wanted = std::size_t(options.heapReserve);
    const std::size_t reserved = reserveHeap(wanted);
    result.obtained = QStringLiteral("%1 byte").arg(reserved);
    result.granted = reserved >= wanted;
    if (!result.granted)
        result.remedy = heapRemedy();
    return {result};
}

// The memory is locked before the stack is touched: what is touched then stays. Scheduling comes
// last but one, so that the slow steps do not run with real-time priority, and before the timer
// slack, which depends on it.
QVector<QPlcRealTimeSetting> applyRealTimeOptions(const QPlcRealTimeOptions &options, Scheduling inherited)
{
    Q_ASSERT_X(options.errorString().isEmpty(), "applyRealTimeOptions", "check errorString() of the options first");
    QVector<QPlcRealTimeSetting> settings;
    if (options.lockMemory)
        settings += applyMemoryLock();
    if (options.prefaultStack > 0)
        settings += applyPrefault(options.prefaultStack);
    if (options.cpu)
        settings += applyCpu(*options.cpu);
    settings.prepend(applyScheduling(options, inherited));
    if (options.timerSlack)
        settings += applyTimerSlack(*options.timerSlack);
    return settings;
}

QVector<QPlcRealTimeSetting> applyRealTimeOptions(const QPlcRealTimeOptions &options)
{
    return applyRealTimeOptions(options, Scheduling::current());
}

}  // namespace qplc

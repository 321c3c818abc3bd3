// SPDX-License-Identifier: Apache-2.0
#include "SystemCheck.h"

#include "Remedies.h"

#include <cerrno>
#include <gnu/libc-version.h>
#include <sched.h>

namespace qplc {

namespace {

// A cycle of a kilohertz has 1 ms: a tenth of it may go to a wake-up under SCHED_FIFO, all of it is
// lost to an ordinary one.
constexpr std::int64_t latestRealTimeWakeUp = 100'000;    // [ns], of 99 %
constexpr std::int64_t latestOrdinaryWakeUp = 1'000'000;  // [ns], of 99 %
constexpr std::int64_t longestRoundTrip = 1'000'000;      // [ns], of 99 %
constexpr int longestIdleExit = 100;                      // [us]
constexpr int smallestRealTimeShare = 90;                 // [per cent]: kernels come with 95

Finding finding(const char *subject, Finding::Verdict verdict, const QString &found, const QString &remedy = QString())
{
    return {QString::fromLatin1(subject), verdict, found, verdict == Finding::ToCure ? remedy : QString()};
}

Finding finding(const char *subject, bool isOk, const QString &found, const QString &remedy)
{
    return finding(subject, isOk ? Finding::Ok : Finding::ToCure, found, remedy);
}

Finding unknown(const char *subject, const QString &why)
{
    return finding(subject, Finding::Unknown, why);
}

/// "p50 12 µs, p99 80 µs, max 130 µs of 1000"
QString distributionText(const Histogram &values)
{
    const auto us = [](std::int64_t ns) { return QString::number((ns + 500) / 1000); };
    return QStringLiteral("p50 %1 µs, p99 %2 µs, max %3 µs of %4")
        .arg(us(values.quantile(0.5)), us(values.quantile(0.99)), us(values.maximum()))
        .arg(values.count());
}

Finding judgeKernel(const SystemFacts &facts)
{
    if (facts.preemption.isEmpty())
        return unknown("kernel", QStringLiteral("/proc/version cannot be read"));
    return finding("kernel", facts.preemption == QLatin1String("PREEMPT_RT"),
                   QStringLiteral("%1, %2").arg(facts.kernel, facts.preemption), kernelRemedy());
}

Finding judgeProcessors(const SystemFacts &facts)
{
    if (facts.processors.isEmpty())
        return unknown("processors", QStringLiteral("/sys/devices/system/cpu cannot be read"));
    const QString isolated = !facts.isolated ? QStringLiteral("isolated: unknown")
        : facts.isolated->isEmpty()          ? QStringLiteral("none isolated")
                                             : QStringLiteral("isolated: %1").arg(*facts.isolated);
    return finding("processors", Finding::Ok, QStringLiteral("%1 online, %2").arg(facts.processors, isolated));
}

Finding judgeClockSource(const SystemFacts &facts)
{
    static const QStringList slow{QStringLiteral("hpet"), QStringLiteral("acpi_pm"), QStringLiteral("jiffies"),
                                  QStringLiteral("refined-jiffies"), QStringLiteral("pit")};
    if (facts.clockSource.isEmpty())
        return unknown("clock source", QStringLiteral("not readable"));
    return finding("clock source", !slow.contains(facts.clockSource), facts.clockSource,
                   clockSourceRemedy(facts.clockSources.contains(QStringLiteral("tsc"))));
}

Finding judgeGovernor(const SystemFacts &facts)
{
    if (facts.governors.isEmpty())
        return unknown("governor", QStringLiteral("no frequency scaling to be seen (virtual machine, or fixed clock)"));
    return finding("governor", facts.governors == QStringList{QStringLiteral("performance")},
                   facts.governors.join(QStringLiteral(", ")), governorRemedy());
}

Finding judgeIdleStates(const SystemFacts &facts)
{
    if (facts.idleStates.isEmpty())
        return unknown("idle states", QStringLiteral("none to be seen"));
    const SystemFacts::IdleState *deepest = nullptr;
    for (const SystemFacts::IdleState &state : facts.idleStates) {
        if (state.isEnabled && (!deepest || state.exitLatency > deepest->exitLatency))
            deepest = &state;
    }
    if (!deepest)
        return finding("idle states", Finding::Ok, QStringLiteral("all disabled"));
    return finding("idle states", deepest->exitLatency <= longestIdleExit,
                   QStringLiteral("deepest %1, %2 µs to wake up").arg(deepest->name).arg(deepest->exitLatency),
                   idleStateRemedy(longestIdleExit));
}

Finding judgeRealTimeShare(const SystemFacts &facts)
{
    if (!facts.realTimeShare)
        return unknown("real-time share", QStringLiteral("/proc/sys/kernel/sched_rt_runtime_us cannot be read"));
    return finding("real-time share", *facts.realTimeShare >= smallestRealTimeShare,
                   QStringLiteral("%1 % of a processor").arg(*facts.realTimeShare), realTimeShareRemedy());
}

/// "unlimited", "8192 KiB"
QString memoryLimitText(const QString &limit)
{
    bool isNumber = false;
    const qulonglong bytes = limit.toULongLong(&isNumber);
    return isNumber ? QStringLiteral("%1 KiB").arg(bytes / 1024) : limit;
}

QString withLimit(const QString &text, const char *name, const QString &limit)
{
    return limit.isEmpty() ? text : QStringLiteral("%1 (limit %2: %3)").arg(text, QLatin1String(name), limit);
}

Finding judgeWakeUps(const char *subject, const WakeUps &wakeUps, std::int64_t latest)
{
    if (!wakeUps.lateness)
        return unknown(subject, QStringLiteral("not measured: the scheduling was refused"));
    return finding(subject, wakeUps.lateness->quantile(0.99) <= latest, distributionText(*wakeUps.lateness),
                   latencyRemedy());
}

Finding judgeSwap(const SystemFacts &facts, bool canLock)
{
    if (!facts.swapSpace)
        return unknown("swap", QStringLiteral("/proc/swaps cannot be read"));
    if (*facts.swapSpace == 0)
        return finding("swap", Finding::Ok, QStringLiteral("none"));
    const QString size = QStringLiteral("%1 MiB").arg(*facts.swapSpace / 1024);
    return finding("swap", canLock,
                   canLock ? size + QStringLiteral(", harmless to locked memory (--lock-memory)") : size, swapRemedy());
}

}  // namespace

QVector<Finding> judgeFacts(const SystemFacts &facts)
{
    return {judgeKernel(facts),   judgeProcessors(facts), judgeClockSource(facts),
            judgeGovernor(facts), judgeIdleStates(facts), judgeRealTimeShare(facts)};
}

QVector<Finding> judgeEffects(const SystemFacts &facts, const WakeUps &ordinary, const WakeUps &realTime)
{
    const QPlcRealTimeSetting scheduling = realTime.setting(QStringLiteral("scheduling"));
    const QPlcRealTimeSetting memory = realTime.setting(QStringLiteral("locked memory"));
    const QString anyProgram = QStringLiteral("PROGRAM");
    return {finding("scheduling", scheduling.granted,
                    withLimit(QStringLiteral("wanted %1, obtained %2").arg(scheduling.wanted, scheduling.obtained),
                              "rtprio", facts.priorityLimit),
                    schedulingRemedy({SCHED_FIFO, 49}, EPERM, anyProgram)),
            finding("locked memory", memory.granted,
                    withLimit(QStringLiteral("wanted %1, obtained %2").arg(memory.wanted, memory.obtained), "memlock",
                              memoryLimitText(facts.memoryLimit)),
                    memoryLockRemedy(EPERM, anyProgram)),
            judgeSwap(facts, memory.granted), judgeWakeUps("wake-up", ordinary, latestOrdinaryWakeUp),
            judgeWakeUps("wake-up FIFO", realTime, latestRealTimeWakeUp)};
}

Finding judgeLoopback(const Histogram &roundTrips)
{
    if (roundTrips.count() == 0)
        return finding("loopback", Finding::ToCure, QStringLiteral("no datagram came back"), loopbackRemedy());
    return finding("loopback", roundTrips.quantile(0.99) <= longestRoundTrip,
                   QStringLiteral("round trip %1").arg(distributionText(roundTrips)), latencyRemedy());
}

Finding judgeVersions(const SystemFacts &facts)
{
    return finding("versions", Finding::Ok,
                   QStringLiteral("QtPLC %1, Qt %2 (built with %3), Linux %4, glibc %5")
                       .arg(QStringLiteral(QTPLC_VERSION), QString::fromLatin1(qVersion()),
                            QStringLiteral(QT_VERSION_STR), facts.kernel, QString::fromLatin1(gnu_get_libc_version())));
}

}  // namespace qplc

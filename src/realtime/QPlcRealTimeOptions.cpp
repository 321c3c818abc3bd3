// SPDX-License-Identifier: Apache-2.0
#include "QPlcRealTimeOptions.h"

namespace {

constexpr int MaximumPriority = 99;
constexpr int MaximumCpu = 1023;                     // what a cpu_set_t holds
constexpr int MaximumPrefault = 64 * 1024 * 1024;    // [byte]
constexpr int MaximumReserve = 1024 * 1024 * 1024;   // [byte]
constexpr qint64 MaximumTimerSlack = 1'000'000'000;  // [ns]
constexpr int MaximumIdleLatency = 1'000'000;        // [us]
constexpr qint64 MaximumSpin = 10'000'000;           // [ns]

QString outOfRange(const char *name, qint64 value, qint64 least, qint64 most, const char *unit = "")
{
    return QStringLiteral("%1 %2: use %3 ... %4%5")
        .arg(QLatin1String(name), QString::number(value), QString::number(least), QString::number(most),
             QString::fromUtf8(unit));
}

QString schedulingError(QPlcRealTimeOptions::Policy policy, int priority)
{
    switch (policy) {
    case QPlcRealTimeOptions::Fifo:
    case QPlcRealTimeOptions::RoundRobin:
        return priority >= 1 && priority <= MaximumPriority ? QString()
                                                            : outOfRange("priority", priority, 1, MaximumPriority);
    case QPlcRealTimeOptions::Inherit:
    case QPlcRealTimeOptions::Other:
        if (priority == 0)
            return {};
        return QStringLiteral(
                   "priority %1 without a real-time policy: set the policy to Fifo or RoundRobin, or the priority to 0")
            .arg(priority);
    }
    return QStringLiteral("policy %1: use Inherit, Other, Fifo or RoundRobin").arg(int(policy));
}

}  // namespace

QString QPlcRealTimeOptions::errorString() const
{
    const QString scheduling = schedulingError(policy, priority);
    if (!scheduling.isEmpty())
        return scheduling;
    if (cpu && (*cpu < 0 || *cpu > MaximumCpu))
        return outOfRange("cpu", *cpu, 0, MaximumCpu);
    if (prefaultStack < 0 || prefaultStack > MaximumPrefault)
        return outOfRange("prefaultStack", prefaultStack, 0, MaximumPrefault, " byte");
    if (heapReserve < 0 || heapReserve > MaximumReserve)
        return outOfRange("heapReserve", heapReserve, 0, MaximumReserve, " byte");
    if (timerSlack && (*timerSlack < 1 || *timerSlack > MaximumTimerSlack))
        return outOfRange("timerSlack", *timerSlack, 1, MaximumTimerSlack, " ns");
    if (idleLatency && (*idleLatency < 0 || *idleLatency > MaximumIdleLatency))
        return outOfRange("idleLatency", *idleLatency, 0, MaximumIdleLatency, " µs");
    if (spin < 0 || spin > MaximumSpin)
        return outOfRange("spin", spin, 0, MaximumSpin, " ns");
    return {};
}

QString QPlcRealTimeSetting::toString() const
{
    const QString text = QStringLiteral("%1: wanted %2, obtained %3").arg(name, wanted, obtained);
    return granted ? text : QStringLiteral("%1; cure: %2").arg(text, remedy);
}

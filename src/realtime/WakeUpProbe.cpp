// SPDX-License-Identifier: Apache-2.0
#include "WakeUpProbe.h"

#include "AlarmTime.h"
#include "RealTimeSetup.h"

#include <sys/mman.h>
#include <thread>

namespace qplc {

QPlcRealTimeSetting WakeUps::setting(const QString &name) const
{
    for (const QPlcRealTimeSetting &setting : settings) {
        if (setting.name == name)
            return setting;
    }
    return {};
}

void recordWakeUps(TimeSource &time, std::chrono::nanoseconds period, int count, Histogram *lateness) noexcept
{
    std::int64_t deadline = time.now();
    for (int i = 0; i < count; ++i) {
        deadline += period.count();
        while (!time.sleepUntil(deadline)) {}
        lateness->record(time.now() - deadline);
    }
}

WakeUps probeWakeUps(const QPlcRealTimeOptions &options, std::chrono::nanoseconds period, int count)
{
    const Scheduling inherited = Scheduling::current();
    WakeUps result;
    std::thread thread([&] {
        result.settings = applyRealTimeOptions(options, inherited);
        if (!result.setting(QStringLiteral("scheduling")).granted)
            return;
        result.lateness = std::make_unique<Histogram>();
        AlarmTime time;  // as the cycle of a master
        time.setPeriod(period.count());
        recordWakeUps(time, period, count, result.lateness.get());
    });
    thread.join();
    if (options.lockMemory)
        munlockall();
    return result;
}

}  // namespace qplc

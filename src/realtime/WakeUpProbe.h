// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Histogram.h"
#include "QPlcRealTimeOptions.h"
#include "TimeSource.h"

#include <chrono>
#include <memory>

namespace qplc {

/// What became of a thread that asked for real time, and how late it woke.
struct WakeUps
{
    QVector<QPlcRealTimeSetting> settings;  ///< wishes and what was obtained
    std::unique_ptr<Histogram>
        lateness;  ///< [ns] after the deadline; null: not measured, since the scheduling was refused

    /// The setting of this name ("scheduling", "locked memory"); none granted where it was not
    /// wished for.
    QPlcRealTimeSetting setting(const QString &name) const;
};

/// Sleeps \a count times until a deadline on a grid of \a period and records how long after it each
/// sleep ended. Never computes: harmless under SCHED_FIFO, too.
void recordWakeUps(TimeSource &time, std::chrono::nanoseconds period, int count, Histogram *lateness) noexcept;

/// Does so on a thread of its own with \a options. Locked memory is unlocked afterwards.
/// \pre options.errorString() is empty
WakeUps probeWakeUps(const QPlcRealTimeOptions &options, std::chrono::nanoseconds period, int count);

}  // namespace qplc

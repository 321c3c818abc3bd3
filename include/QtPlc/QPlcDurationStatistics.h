// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDistribution.h"

/// A duration that is measured in every cycle: its distribution over two spans of time.
///
/// \code
/// QPlcMasterNode master;
/// const QPlcDurationStatistics execution = master.cycleStatistics().execution;
/// qInfo("now %lld ns, since the start %lld ns", execution.last10s.p99, execution.sinceStart.p99);
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcDurationStatistics
{
    /// Since the start of the real-time phase. Percentiles are at most 1/32 (3.2 %) above the true
    /// ones.
    QPlcDistribution sinceStart;
    /// Over the last 10 s: the second in which the newest cycle began, and the nine seconds before
    /// it, on the clock of the machine. Percentiles are at most 1/8 (12.5 %) above the true ones.
    QPlcDistribution last10s;
};

Q_DECLARE_METATYPE(QPlcDurationStatistics)

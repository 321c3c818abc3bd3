// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDistribution.h"

/// A duration that is measured in every cycle: its distribution over two times. A value type.
struct QPlcDurationStatistics
{
    /// Since the start of the real-time phase. Percentiles are at most 1/32 (3.2 %) above the true ones.
    QPlcDistribution sinceStart;
    /// Over the last 10 s, that is the second in which the newest cycle began and the nine seconds before it (seconds of the clock of the machine).
    /// Percentiles are at most 1/8 (12.5 %) above the true ones.
    QPlcDistribution last10s;
};

Q_DECLARE_METATYPE(QPlcDurationStatistics)

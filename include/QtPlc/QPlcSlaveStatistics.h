// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDurationStatistics.h"

/// What a node over the network has measured of its own cycles since the start of the real-time phase. All durations in ns. A value type.
///
/// How late a frame is cannot be said here: the clock of the node knows nothing of the clock of the master. All figures are differences of one clock. In lockstep no
/// clock is read: they have no values. QPlcSlaveNode::counters() has the counters.
struct QPlcSlaveStatistics
{
    /// From the inputs at hand to the outputs ready: step() or realTimeout().
    QPlcDurationStatistics execution;
    /// From the moment at which the cycle thread has a whole frame to the moment at which the answer is given to the operating system.
    QPlcDurationStatistics response;
    /// Between the arrivals of two successive frames that were computed; with cycles missed it is several periods long.
    /// Its spread is the lateness of the master and the spread of the network together.
    QPlcDurationStatistics interval;
    /// One period (as long as it takes on the clock of the machine) - the response; 0 when that is longer. What is left of a cycle that begins with the
    /// arrival of its frame; the time on the network is not in it.
    QPlcDurationStatistics slack;
};

Q_DECLARE_METATYPE(QPlcSlaveStatistics)

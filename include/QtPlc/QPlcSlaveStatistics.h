// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDurationStatistics.h"

/// What a node over the network has measured of its own cycles since the start of the real-time
/// phase. All durations are in ns.
///
/// \code
/// QPlcIOSlaveNode node("Operator");
/// const QPlcSlaveStatistics statistics = node.statistics();
/// qInfo("99 %% of the steps took at most %lld ns", statistics.execution.sinceStart.p99);
/// \endcode
///
/// All figures are differences of one clock, that of the node. A node cannot measure the lateness
/// of a frame, because the clock of the master is another one. In lockstep no clock is read, and no
/// figure has values. QPlcSlaveNode::counters() has the counters.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcSlaveStatistics
{
    /// From the inputs at hand to the outputs ready: the time of step() or realTimeout().
    QPlcDurationStatistics execution;
    /// From the moment at which the cycle thread has a whole frame to the moment at which it has
    /// given the answer to the operating system.
    QPlcDurationStatistics response;
    /// Time between the arrivals of two successive frames that were computed. It is several periods
    /// long when cycles were missed. Its spread contains the lateness of the master and the jitter
    /// of the network.
    QPlcDurationStatistics interval;
    /// One period on the clock of the machine minus the response; 0 when the response is longer.
    /// The time on the network is not part of it.
    QPlcDurationStatistics slack;
};

Q_DECLARE_METATYPE(QPlcSlaveStatistics)

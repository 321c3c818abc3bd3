// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeStatistics.h"
#include "QPlcWorstCycle.h"

#include <QtCore/QVector>

/// All that a master has measured of its cycles since the start of the real-time phase. All
/// durations are in ns.
///
/// \code
/// QPlcMasterNode master;
/// const QPlcCycleStatistics statistics = master.cycleStatistics(QPlcDistribution::WithBins);
/// qInfo("%llu cycles, %llu overruns, lateness p99 %lld ns", statistics.cycles,
///       statistics.overruns, statistics.lateness.sinceStart.p99);
/// \endcode
///
/// Every computed cycle gives one value of lateness, execution and slack. Cycles that are left out
/// after an overrun give none; skippedCycles counts them, and the worst cycles show the delay that
/// caused it. No value is left out otherwise, and all values refer to the nominal time: a cycle
/// that is late because the one before was slow counts as late. In lockstep no clock is read:
/// durations have no values, and there are no worst cycles. docs/design/statistics.md defines the
/// figures.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcCycleStatistics
{
    /// Begin of a cycle minus its nominal time (start + k * period). With QPlcOverrunPolicy::Shift
    /// it is the nominal time before the shift. With SkipToGrid it is less than a period.
    QPlcDurationStatistics lateness;
    /// From the begin of a cycle to its end, without the time spent waiting for answers: the master
    /// itself and the nodes in its process.
    QPlcDurationStatistics execution;
    /// From the begin of sending the requests to the moment at which the master has the last answer
    /// that came in this cycle. A cycle without an answer (no node over the network, or all of them
    /// late) gives no value.
    QPlcDurationStatistics roundTrip;
    /// From the end of a cycle to the nominal time of the next one; 0 when it ended later.
    QPlcDurationStatistics slack;

    quint64 cycles = 0;  ///< cycles that were computed
    /// Times that a cycle could begin only a period or more after its nominal time. A run of cycles
    /// that are caught up counts once.
    quint64 overruns = 0;
    /// Cycles that were left out (SkipToGrid, CatchUp beyond its limit).
    quint64 skippedCycles = 0;
    quint64 caughtUpCycles = 0;  ///< cycles that were computed after their period (CatchUp)
    qint64 shiftedTime = 0;      ///< time by which the grid has moved after overruns (Shift) [ns]
    quint64 lateAnswers = 0;     ///< late answers of all nodes, also of those that have left
    /// Cycles that ended without the answer of at least one node. Each cycle counts once, with any
    /// number of late answers.
    quint64 incompleteCycles = 0;
    quint64 strangers = 0;  ///< datagrams from addresses that belong to no node
    /// Times that more frames had arrived than may be read at once; the rest waited.
    quint64 floods = 0;

    QVector<QPlcNodeStatistics> nodes;  ///< one entry per node, in the order of their registration
    QVector<QPlcWorstCycle> worst;      ///< at most 16, the worst one first
};

Q_DECLARE_METATYPE(QPlcCycleStatistics)

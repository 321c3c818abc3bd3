// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeStatistics.h"
#include "QPlcWorstCycle.h"

#include <QtCore/QVector>

/// Everything that a master has measured of its cycles since the start of the real-time phase. All durations in ns. A value type.
///
/// Every cycle that is computed gives one value of lateness, execution and slack. Cycles that are left out after an overrun give none and are counted apart
/// (skippedCycles): the delay that made them fall out stands in the worst cycles. Nothing else is left out, and no value is related to anything but the
/// nominal time: a cycle that is late because the one before was slow counts as late. In lockstep no clock is read: durations have no values, and the
/// worst cycles are empty.
struct QPlcCycleStatistics
{
    /// Actual begin of a cycle - its nominal time t0 + k * period. With QPlcOverrunPolicy::Shift the nominal time before the shift; it is less than a period with SkipToGrid.
    QPlcDurationStatistics lateness;
    /// From the begin of a cycle to its end without the time spent waiting for answers: the master itself and the nodes in its process.
    QPlcDurationStatistics execution;
    /// From the begin of the sending of the requests to the moment at which the master has the last answer to them that came in this cycle. Cycles without
    /// any such answer (no node over the network, all of them late) give no value.
    QPlcDurationStatistics roundTrip;
    /// From the end of a cycle to the nominal time of the next one; 0 when it ended later.
    QPlcDurationStatistics slack;

    quint64 cycles = 0;  ///< computed
    quint64 overruns
        = 0;  ///< times that a cycle could begin only a period or more after its nominal time; a run of cycles caught up is one
    quint64 skippedCycles = 0;   ///< left out (SkipToGrid, CatchUp beyond its limit)
    quint64 caughtUpCycles = 0;  ///< computed although their period was over (CatchUp)
    qint64 shiftedTime = 0;      ///< by which the grid has moved after overruns (Shift) [ns]
    quint64 lateAnswers = 0;     ///< over all nodes, those that have left included
    quint64 incompleteCycles
        = 0;  ///< computed, but over without the answer of at least one node: one for each cycle, however many answers were late
    quint64 strangers = 0;  ///< datagrams from addresses that belong to no node
    quint64 floods = 0;     ///< times that more had arrived than may be read at once; the rest waited

    QVector<QPlcNodeStatistics> nodes;  ///< in the order of their registration
    QVector<QPlcWorstCycle> worst;      ///< at most 16, the worst one first
};

Q_DECLARE_METATYPE(QPlcCycleStatistics)

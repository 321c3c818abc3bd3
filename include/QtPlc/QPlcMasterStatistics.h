// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// The short form of QPlcCycleStatistics: counters and durations of a master since the start of its
/// last real-time phase.
///
/// \code
/// QPlcMasterNode master;
/// const QPlcMasterStatistics statistics = master.statistics();
/// qInfo("%llu cycles, %llu late answers", statistics.cycles, statistics.lateAnswers);
/// \endcode
///
/// Reading it is quick: it has no distributions.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcMasterStatistics
{
    quint64 cycles = 0;         ///< cycles that were computed
    quint64 overruns = 0;       ///< times that a cycle began a period or more late
    quint64 skippedCycles = 0;  ///< cycles that were left out to get back on the grid
    /// Cycles that were computed after their period (QPlcOverrunPolicy::CatchUp).
    quint64 caughtUpCycles = 0;
    /// Time by which the grid has moved after overruns (QPlcOverrunPolicy::Shift) [ns].
    qint64 shiftedTime = 0;
    quint64 lateAnswers = 0;       ///< late answers of all nodes
    quint64 incompleteCycles = 0;  ///< cycles that ended without the answer of at least one node
    quint64 strangers = 0;         ///< datagrams from addresses that belong to no node
    /// Times that more frames had arrived than may be read at once; the rest waited.
    quint64 floods = 0;
    /// Connections for which there was no room, since startServer().
    quint64 refusedConnections = 0;
    /// Connections since startServer() that had no valid key or certificate, or were too slow.
    quint64 failedHandshakes = 0;
    quint64 deniedMessages = 0;  ///< messages since startServer() without the right to them
    qint64 latenessMedian = 0;   ///< median of the wake-up minus the nominal time [ns]
    qint64 lateness99 = 0;       ///< 99th percentile of it [ns]
    qint64 latenessMaximum = 0;  ///< largest one [ns]
    /// Median of the time from the first request to the last answer [ns].
    qint64 roundTripMedian = 0;
    qint64 roundTrip99 = 0;       ///< 99th percentile of it [ns]
    qint64 roundTripMaximum = 0;  ///< longest one [ns]
    /// Digest of the values of all signals in all cycles, in their order. Two runs in lockstep are
    /// equal if their digests are equal.
    quint64 imageDigest = 0;
};

Q_DECLARE_METATYPE(QPlcMasterStatistics)

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// The short form of QPlcCycleStatistics, quick to read: counters and durations of a master since the start of its last real-time phase. A value type.
struct QPlcMasterStatistics
{
    quint64 cycles = 0;            ///< computed
    quint64 overruns = 0;          ///< times that a cycle began a period or more late
    quint64 skippedCycles = 0;     ///< cycles left out to get back on the grid
    quint64 caughtUpCycles = 0;    ///< cycles computed although their period was over (QPlcOverrunPolicy::CatchUp)
    qint64 shiftedTime = 0;        ///< by which the grid has moved after overruns (QPlcOverrunPolicy::Shift) [ns]
    quint64 lateAnswers = 0;       ///< over all nodes
    quint64 incompleteCycles = 0;  ///< cycles that ended without the answer of at least one node
    quint64 strangers = 0;         ///< datagrams from addresses that belong to no node
    quint64 floods = 0;            ///< times that more had arrived than may be read at once; the rest waited
    qint64 latenessMedian = 0;     ///< wake-up after the nominal time [ns]
    qint64 lateness99 = 0;         ///< 99th percentile [ns]
    qint64 latenessMaximum = 0;    ///< [ns]
    qint64 roundTripMedian = 0;    ///< first request out to last answer in [ns]
    qint64 roundTrip99 = 0;        ///< [ns]
    qint64 roundTripMaximum = 0;   ///< [ns]
    quint64 imageDigest = 0;       ///< over the process image of every cycle, in order
};

Q_DECLARE_METATYPE(QPlcMasterStatistics)

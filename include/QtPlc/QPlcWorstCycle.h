// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// One of the cycles of a master that ended latest after their nominal time. All durations are in
/// ns.
///
/// \code
/// QPlcMasterNode master;
/// const QVector<QPlcWorstCycle> worst = master.cycleStatistics().worst;
/// if (!worst.isEmpty())
///     qInfo("cycle %llu began %lld ns late", worst.first().cycle, worst.first().lateness);
/// \endcode
///
/// Cycles are compared by a cost: the time from the nominal time of the first cycle that was due
/// (skipped ones count) to the begin of this one, plus the longer one of its execution time and its
/// round trip.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcWorstCycle
{
    /// A part of the cycle.
    struct Stage
    {
        QString name;         ///< "commands", "ask", "local nodes", "collect" or "finish"
        qint64 duration = 0;  ///< time that it took, waiting included [ns]
    };

    quint64 cycle = 0;      ///< number of the cycle
    quint64 skipped = 0;    ///< number of cycles that were left out right before it
    qint64 lateness = 0;    ///< begin of the cycle minus its nominal time [ns]
    qint64 execution = 0;   ///< time of master and local nodes, without waiting for answers [ns]
    qint64 roundTrip = 0;   ///< first request sent to last answer [ns]; 0: no node answered
    qint64 slack = 0;       ///< end of the cycle to the nominal time of the next one [ns]
    QVector<Stage> stages;  ///< parts of the cycle, in their order
};

Q_DECLARE_METATYPE(QPlcWorstCycle)

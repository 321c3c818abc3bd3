// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// One of the cycles of a master that ended latest after their nominal time. All durations in ns. A value type.
///
/// The cost by which cycles are compared is the time from the nominal time of the first cycle that was due (skipped ones count) to the begin of this one, plus
/// the larger one of its execution time and its round trip.
struct QPlcWorstCycle
{
    /// A part of the cycle: "commands", "ask", "local nodes", "collect", "finish".
    struct Stage
    {
        QString name;
        qint64 duration = 0;  ///< [ns] waiting included
    };

    quint64 cycle = 0;      ///< its number
    quint64 skipped = 0;    ///< cycles left out right before it
    qint64 lateness = 0;    ///< [ns] see QPlcCycleStatistics
    qint64 execution = 0;   ///< [ns]
    qint64 roundTrip = 0;   ///< [ns] 0: no node answered
    qint64 slack = 0;       ///< [ns]
    QVector<Stage> stages;  ///< in the order in which they happen
};

Q_DECLARE_METATYPE(QPlcWorstCycle)

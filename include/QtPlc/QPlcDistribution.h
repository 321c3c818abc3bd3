// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QVector>

/// How a duration was distributed. All durations are in ns, and all are 0 if there was no value.
///
/// \code
/// QPlcMasterNode master;
/// const QPlcDistribution lateness = master.cycleStatistics().lateness.sinceStart;
/// qInfo("99 %% of the cycles began at most %lld ns late", lateness.p99);
/// \endcode
///
/// A percentile pXX is a number that XX % of all values, and at least one, do not exceed. It is
/// never below the true one. It is above the true one by at most the relative error that its source
/// states (QPlcDurationStatistics). Count, minimum, mean and maximum are exact. Where small values
/// are the critical ones (the slack to a deadline), look at minimum, p001 and p01.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcDistribution
{
    /// A bin of the histogram.
    struct Bin
    {
        qint64 upperBorder = 0;  ///< largest value that belongs into the bin [ns]
        quint64 count = 0;       ///< number of values in the bin
    };

    /// What a reader asks for. Bins take time and memory.
    enum Detail : quint8 {
        FiguresOnly,  ///< without bins
        WithBins      ///< with bins
    };

    quint64 count = 0;   ///< number of values
    qint64 minimum = 0;  ///< smallest value [ns]
    double mean = 0.0;   ///< mean value [ns]
    qint64 p001 = 0;     ///< 0.1 % of the values do not exceed it [ns]
    qint64 p01 = 0;      ///< 1 % of the values do not exceed it [ns]
    qint64 p50 = 0;      ///< median [ns]
    qint64 p99 = 0;      ///< 99 % of the values do not exceed it [ns]
    qint64 p999 = 0;     ///< 99.9 % of the values do not exceed it [ns]
    qint64 maximum = 0;  ///< largest value [ns]
    QVector<Bin> bins;   ///< bins that are not empty, in rising order; empty with FiguresOnly
};

Q_DECLARE_METATYPE(QPlcDistribution)

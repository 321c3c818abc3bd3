// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QVector>

/// How a duration was distributed. All durations in ns; all 0 when there was no value. A value type.
///
/// A percentile pXX is a number that XX % of all values, and at least one, do not exceed. It is never below the true one, and above it by at most the relative
/// error that the source of the distribution states. Count, minimum, mean and maximum are exact. Where small values are the bad ones (the slack to a deadline),
/// look at minimum, p001 and p01.
struct QPlcDistribution
{
    /// Values that share a bin of the histogram.
    struct Bin
    {
        qint64 upperBorder = 0;  ///< largest value that belongs into the bin [ns]
        quint64 count = 0;
    };

    /// What is asked for: bins take time and memory.
    enum Detail : quint8 { FiguresOnly, WithBins };

    quint64 count = 0;   ///< number of values
    qint64 minimum = 0;  ///< [ns]
    double mean = 0.0;   ///< [ns]
    qint64 p001 = 0;     ///< 0.1 % [ns]
    qint64 p01 = 0;      ///< 1 % [ns]
    qint64 p50 = 0;      ///< median [ns]
    qint64 p99 = 0;      ///< 99 % [ns]
    qint64 p999 = 0;     ///< 99.9 % [ns]
    qint64 maximum = 0;  ///< [ns]
    QVector<Bin> bins;   ///< without empty ones, rising; empty unless asked for
};

Q_DECLARE_METATYPE(QPlcDistribution)

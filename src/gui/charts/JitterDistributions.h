// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"

namespace qplc {

/// How one duration of a master or a node was distributed, ready to be drawn. A value type.
struct JitterDistribution
{
    /// Values from low to below high [ns].
    struct Bin
    {
        double low;
        double high;
        double count;
    };

    QString who;       // "Master", or a node
    QString quantity;  // "lateness", "execution", "roundTrip", as docs/protocol.md 5.6 names them
    double count = 0.0;
    double p50 = 0.0;      // [ns]
    double p99 = 0.0;      // [ns]
    double maximum = 0.0;  // [ns]
    QVector<Bin> bins;     // rising, of an eighth of a power of two each, without empty ones

    /// For settings: "Master.lateness".
    QString key() const { return who + QLatin1Char('.') + quantity; }
    /// For people: "Master lateness".
    QString title() const { return titleOf(key()); }
    static QString titleOf(const QString &key);
};

/// The distributions of all durations.
/// \param window  &QPlcDurationStatistics::sinceStart or &QPlcDurationStatistics::last10s
QVector<JitterDistribution> jitterDistributions(const QVector<QPlcPanelContext::Duration> &durations,
                                                QPlcDistribution QPlcDurationStatistics::*window);

}  // namespace qplc

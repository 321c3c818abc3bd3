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

    // Quantities, as QPlcPanelContext::Duration and settings name them.
    static constexpr const char *Lateness = "lateness";
    static constexpr const char *Execution = "execution";
    static constexpr const char *RoundTrip = "roundTrip";

    QString who;  // "Master", or a node
    QString quantity;
    double count = 0.0;
    double p50 = 0.0;      // [ns]
    double p99 = 0.0;      // [ns]
    double maximum = 0.0;  // [ns]
    QVector<Bin> bins;     // rising, of an eighth of a power of two each, without empty ones

    /// For settings: "Master.lateness".
    QString key() const { return who + QLatin1Char('.') + quantity; }
    static QString keyOfMaster(const char *quantity) { return QStringLiteral("Master.") + QLatin1String(quantity); }
    /// For people: "Master lateness".
    QString title() const { return titleOf(key()); }
    static QString titleOf(const QString &key);
};

/// The distributions of all durations.
/// \param window  &QPlcDurationStatistics::sinceStart or &QPlcDurationStatistics::last10s
QVector<JitterDistribution> jitterDistributions(const QVector<QPlcPanelContext::Duration> &durations,
                                                QPlcDistribution QPlcDurationStatistics::*window);

}  // namespace qplc

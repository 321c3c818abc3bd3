// SPDX-License-Identifier: Apache-2.0
#include "JitterDistributions.h"

#include <QtCore/QCoreApplication>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

using Bin = JitterDistribution::Bin;

constexpr double binsOfOctave = 8.0;  // the coarser one of the two histograms of a master

/// The bin with a value; those of finer histograms lie whole in it.
Bin binOf(double value)
{
    if (value < binsOfOctave)
        return {std::floor(value), std::floor(value) + 1.0, 0.0};
    const double width = std::exp2(std::floor(std::log2(value))) / binsOfOctave;
    const double low = std::floor(value / width) * width;
    return {low, low + width, 0.0};
}

QVector<Bin> binsOf(const QVector<QPlcDistribution::Bin> &all)
{
    QVector<Bin> bins;
    for (const QPlcDistribution::Bin &each : all) {
        if (each.upperBorder < 0 || each.count == 0)
            continue;
        const Bin bin = binOf(double(each.upperBorder));
        if (bins.isEmpty() || bin.low > bins.last().low)
            bins.append(bin);
        bins.last().count += double(each.count);
    }
    return bins;
}

double atLeastZero(qint64 duration)
{
    return double(std::max<qint64>(duration, 0));
}

QString quantityText(const QString &quantity)
{
    const auto text = [](const char *name) { return QCoreApplication::translate("JitterDistribution", name); };
    if (quantity == QLatin1String(JitterDistribution::RoundTrip))
        return text("round trip");
    return text(quantity.toLatin1().constData());
}

}  // namespace

QString JitterDistribution::titleOf(const QString &key)
{
    const int point = key.lastIndexOf(QLatin1Char('.'));
    return QStringLiteral("%1 %2").arg(key.left(point), quantityText(key.mid(point + 1)));
}

QVector<JitterDistribution> jitterDistributions(const QVector<QPlcPanelContext::Duration> &durations,
                                                QPlcDistribution QPlcDurationStatistics::*window)
{
    QVector<JitterDistribution> all;
    for (const QPlcPanelContext::Duration &duration : durations) {
        const QPlcDistribution &of = duration.statistics.*window;
        all.append({duration.owner, duration.name, double(of.count), atLeastZero(of.p50), atLeastZero(of.p99),
                    atLeastZero(of.maximum), binsOf(of.bins)});
    }
    return all;
}

}  // namespace qplc

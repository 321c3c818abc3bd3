// SPDX-License-Identifier: Apache-2.0
#include "JitterDistributions.h"

#include "node/Logging.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QJsonArray>

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

QVector<Bin> binsOf(const QJsonArray &array)
{
    QVector<Bin> bins;
    for (const QJsonValue &item : array) {
        const double border = item[0].toDouble();
        const double count = item[1].toDouble();
        if (!(border >= 0.0) || !(count > 0.0))
            continue;
        const Bin bin = binOf(border);
        if (bins.isEmpty() || bin.low > bins.last().low)
            bins.append(bin);
        bins.last().count += count;
    }
    return bins;
}

double number(const QJsonObject &fields, const char *name)
{
    return std::max(fields.value(QLatin1String(name)).toDouble(), 0.0);
}

void append(QVector<JitterDistribution> *all, const QString &who, const QJsonObject &fields, const QString &window)
{
    for (const char *quantity : {"lateness", "execution", "roundTrip"}) {
        const QJsonValue duration = fields.value(QLatin1String(quantity));
        if (!duration.isObject())
            continue;
        const QJsonObject of = duration[window].toObject();
        all->append({who, QString::fromLatin1(quantity), number(of, "count"), number(of, "p50"), number(of, "p99"),
                     number(of, "maximum"), binsOf(of.value(QLatin1String("bins")).toArray())});
    }
}

QString quantityText(const QString &quantity)
{
    const auto text = [](const char *name) { return QCoreApplication::translate("JitterDistribution", name); };
    if (quantity == QLatin1String("roundTrip"))
        return text("round trip");
    return text(quantity.toLatin1().constData());
}

}  // namespace

QString JitterDistribution::titleOf(const QString &key)
{
    const int point = key.lastIndexOf(QLatin1Char('.'));
    return QStringLiteral("%1 %2").arg(key.left(point), quantityText(key.mid(point + 1)));
}

QVector<JitterDistribution> jitterDistributions(const QJsonObject &statistics, const QString &window)
{
    QVector<JitterDistribution> all;
    append(&all, QStringLiteral("Master"), statistics.value(QLatin1String("master")).toObject(), window);
    const QJsonArray nodes = statistics.value(QLatin1String("nodes")).toArray();
    for (const QJsonValue &node : nodes)
        append(&all, printable(node[QLatin1String("name")].toString()), node.toObject(), window);
    return all;
}

}  // namespace qplc

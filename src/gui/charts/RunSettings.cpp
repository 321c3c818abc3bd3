// SPDX-License-Identifier: Apache-2.0
#include "RunSettings.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace qplc {

namespace {

const QString onKey = QStringLiteral("on");
const QString plantsKey = QStringLiteral("plants");
const QString alignKey = QStringLiteral("align");
const QString signalKey = QStringLiteral("signal");
const QString levelKey = QStringLiteral("level");
const QString lastKey = QStringLiteral("last");
const QString apartKey = QStringLiteral("apart");
const QString clockText = QStringLiteral("clock");
const QString edgeText = QStringLiteral("edge");

constexpr int usualLast = 10;

}  // namespace

RunSettings RunSettings::fromJson(const QJsonObject &json)
{
    RunSettings settings;
    settings.others = json;
    settings.isOn = settings.others.take(onKey).toBool();
    const QJsonArray plants = settings.others.take(plantsKey).toArray();
    for (const QJsonValue &plant : plants)
        settings.plants << plant.toString();
    const QString align = settings.others.take(alignKey).toString();
    settings.alignment = align == clockText ? Clock : align == edgeText ? RisingEdges : Begins;
    settings.signal = settings.others.take(signalKey).toString();
    settings.level = settings.others.take(levelKey).toDouble();
    settings.last = std::clamp(settings.others.take(lastKey).toInt(usualLast), 1, MostLast);
    settings.apart = std::max(settings.others.take(apartKey).toDouble(), 0.0);
    return settings;
}

QJsonObject RunSettings::toJson() const
{
    QJsonObject json = others;
    if (isOn)
        json.insert(onKey, true);
    if (!plants.isEmpty())
        json.insert(plantsKey, QJsonArray::fromStringList(plants));
    if (alignment != Begins)
        json.insert(alignKey, alignment == Clock ? clockText : edgeText);
    if (!signal.isEmpty())
        json.insert(signalKey, signal);
    if (level != 0.0)
        json.insert(levelKey, level);
    if (last != usualLast)
        json.insert(lastKey, last);
    if (apart != 0.0)
        json.insert(apartKey, apart);
    return json;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "RunSettings.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace qplc {

namespace {

const QString onRunKey = QStringLiteral("on");
const QString plantsRunKey = QStringLiteral("plants");
const QString alignRunKey = QStringLiteral("align");
const QString signalRunKey = QStringLiteral("signal");
const QString levelRunKey = QStringLiteral("level");
const QString lastRunKey = QStringLiteral("last");
const QString apartRunKey = QStringLiteral("apart");
const QString differencesRunKey = QStringLiteral("differences");
const QString clockAlignment = QStringLiteral("clock");
const QString edgeAlignment = QStringLiteral("edge");

constexpr int usualLast = 10;

}  // namespace

RunSettings RunSettings::fromJson(const QJsonObject &json)
{
    RunSettings settings;
    settings.others = json;
    settings.isOn = settings.others.take(onRunKey).toBool();
    const QJsonArray plants = settings.others.take(plantsRunKey).toArray();
    for (const QJsonValue &plant : plants)
        settings.plants << plant.toString();
    const QString align = settings.others.take(alignRunKey).toString();
    settings.alignment = align == clockAlignment ? Clock : align == edgeAlignment ? RisingEdges : Begins;
    settings.signal = settings.others.take(signalRunKey).toString();
    settings.level = settings.others.take(levelRunKey).toDouble();
    settings.last = std::clamp(settings.others.take(lastRunKey).toInt(usualLast), 1, MostLast);
    settings.apart = std::max(settings.others.take(apartRunKey).toDouble(), 0.0);
    settings.isDifference = settings.others.take(differencesRunKey).toBool();
    return settings;
}

QJsonObject RunSettings::toJson() const
{
    QJsonObject json = others;
    if (isOn)
        json.insert(onRunKey, true);
    if (!plants.isEmpty())
        json.insert(plantsRunKey, QJsonArray::fromStringList(plants));
    if (alignment != Begins)
        json.insert(alignRunKey, alignment == Clock ? clockAlignment : edgeAlignment);
    if (!signal.isEmpty())
        json.insert(signalRunKey, signal);
    if (level != 0.0)
        json.insert(levelRunKey, level);
    if (last != usualLast)
        json.insert(lastRunKey, last);
    if (apart != 0.0)
        json.insert(apartRunKey, apart);
    if (isDifference)
        json.insert(differencesRunKey, true);
    return json;
}

}  // namespace qplc

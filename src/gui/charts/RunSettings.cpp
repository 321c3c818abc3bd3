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
const QString hiddenRunKey = QStringLiteral("hidden");
const QString eventRunKey = QStringLiteral("event");

constexpr int usualLast = 10;

/// In the order of RunSettings::Alignment.
QStringList alignmentNames()
{
    return {QStringLiteral("begin"), QStringLiteral("clock"), QStringLiteral("edge"), QStringLiteral("event"),
            QStringLiteral("pause")};
}

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
    const int known = alignmentNames().indexOf(align);
    settings.alignment = known < 0 ? Begins : Alignment(known);
    settings.event = settings.others.take(eventRunKey).toString();
    settings.signal = settings.others.take(signalRunKey).toString();
    settings.level = settings.others.take(levelRunKey).toDouble();
    settings.last = std::clamp(settings.others.take(lastRunKey).toInt(usualLast), 1, MostLast);
    settings.apart = std::max(settings.others.take(apartRunKey).toDouble(), 0.0);
    settings.isDifference = settings.others.take(differencesRunKey).toBool();
    const QJsonArray hidden = settings.others.take(hiddenRunKey).toArray();
    for (const QJsonValue &name : hidden)
        settings.hidden << name.toString();
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
        json.insert(alignRunKey, alignmentNames().at(alignment));
    if (!event.isEmpty())
        json.insert(eventRunKey, event);
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
    if (!hidden.isEmpty())
        json.insert(hiddenRunKey, QJsonArray::fromStringList(hidden));
    return json;
}

}  // namespace qplc

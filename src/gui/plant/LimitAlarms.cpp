// SPDX-License-Identifier: Apache-2.0
#include "LimitAlarms.h"

namespace qplc {

namespace {

constexpr int digits = 6;

QString numberOf(double value, const QString &unit)
{
    return QStringLiteral("%1 %2").arg(QString::number(value, 'g', digits), unit).trimmed();
}

}  // namespace

LimitAlarms::LimitAlarms(PlantList *plants, QObject *parent)
    : QObject(parent)
{
    plants->forEach(this, &LimitAlarms::follow);
}

void LimitAlarms::follow(Plant *plant)
{
    if (!plant->feed())
        return;
    begin(plant);
    connect(plant, &Plant::storeChanged, this, [this, plant] { begin(plant); });
    connect(plant, &Plant::updated, this, [this, plant] { check(plant); });
    connect(plant, &QObject::destroyed, this, [this, plant] { m_plants.erase(plant); });
}

/// What lasted is watched no more.
void LimitAlarms::begin(Plant *plant)
{
    Watched &watched = m_plants[plant];
    for (const QString &alarm : qAsConst(watched.alarms)) {
        PlantEvent event;
        event.time = QDateTime::currentDateTime();
        event.source = plant->name();
        event.text = tr("%1: over, the plant has begun anew").arg(alarm);
        event.stage = PlantEvent::Ends;
        event.alarm = alarm;
        Q_EMIT eventOccurred(event);
    }
    watched.alarms.clear();
    watched.watch.setTable(plant->table(), plant->values().channels(), plant->store());
}

void LimitAlarms::check(Plant *plant)
{
    if (!plant->store())
        return;
    Watched &watched = m_plants[plant];
    for (const LimitWatch::Change &change : watched.watch.check(*plant->store())) {
        const PlantEvent event = eventOf(*plant, change);
        if (change.isOutside)
            watched.alarms.insert(event.alarm);
        else
            watched.alarms.remove(event.alarm);
        Q_EMIT eventOccurred(event);
    }
}

PlantEvent LimitAlarms::eventOf(const Plant &plant, const LimitWatch::Change &change)
{
    const QPlcSignalDefinition &definition = plant.table().at(change.signal);
    const QString signal = definition.type.isArray() ? QStringLiteral("%1[%2]").arg(definition.name).arg(change.element)
                                                     : definition.name;
    const QString farthest = numberOf(change.farthest, definition.unit);
    PlantEvent event;
    event.time = QDateTime::fromMSecsSinceEpoch(change.time / 1'000'000);
    event.severity = change.isOutside ? PlantEvent::Warning : PlantEvent::Information;
    event.source = plant.name();
    event.stage = change.isOutside ? PlantEvent::Begins : PlantEvent::Ends;
    event.alarm = QStringLiteral("limits of ") + signal;
    event.text = change.isOutside
        ? tr("%1 = %2 is outside of its limits, %3").arg(signal, farthest, definition.rangeText())
        : tr("%1 is within its limits again, after %2 s; the farthest value was %3")
              .arg(signal)
              .arg(double(change.time - change.since) * 1e-9, 0, 'f', 2)
              .arg(farthest);
    return event;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "CurveSources.h"

#include "DerivedSignals.h"
#include "gui/LimitOf.h"

namespace qplc {

CurveSources::CurveSources(PlantList *plants, QObject *parent)
    : QObject(parent)
    , m_plants(plants)
    , m_derived(std::make_unique<DerivedSignals>(plants))
{
    connect(plants, &PlantList::signalsChanged, m_derived.get(), &DerivedSignals::forgetStale);
    connect(plants, &PlantList::signalsChanged, this, &CurveSources::changed);
    connect(m_derived.get(), &DerivedSignals::filled, this, &CurveSources::filled);
    plants->forEach(this, &CurveSources::follow);
}

CurveSources::~CurveSources() = default;

QString CurveSource::textOf(const QString &expression)
{
    return Formula::isFormula(expression) ? expression.trimmed().mid(1).trimmed() : expression;
}

CurveSource CurveSources::find(const QString &expression, const QString &pin) const
{
    if (Formula::isFormula(expression))
        return findFormula(expression, pin);
    CurveSource source;
    source.title = expression;
    const SignalReference reference = SignalReference::fromString(expression, &source.error);
    if (!reference.isValid())
        return source;
    const PlantList::Signal signal = m_plants->resolve(reference, pin);
    if (!signal || !signal.plant->store()) {
        source.error = tr("There is no signal %1 at the moment.").arg(expression);
        return source;
    }
    source.channel = signal.channel();
    if (source.channel == ChannelMap::NoChannel) {
        source.error = tr("%1 is not a number. Remedy: choose one of its elements.").arg(expression);
        return source;
    }
    const QPlcSignalDefinition &definition = signal.definition();
    source.plant = signal.plant;
    source.store = signal.plant->store();
    source.unit = definition.unit;
    source.minimum = limitOf(definition.minimum);
    source.maximum = limitOf(definition.maximum);
    source.names = definition.valueNames;
    source.isStepped = !definition.type.isReal();
    return source;
}

CurveSource CurveSources::findFormula(const QString &expression, const QString &pin) const
{
    CurveSource source;
    source.title = expression.trimmed();
    const DerivedSignals::Result found = m_derived->find(source.title, pin);
    source.error = found.error;
    if (!found.derived)
        return source;
    source.derived = found.derived;
    source.plant = found.plant;
    source.store = &found.derived->store();
    source.channel = 0;
    source.unit = found.unit;
    return source;
}

void CurveSources::follow(Plant *plant)
{
    connect(plant, &Plant::storeChanged, this, [this, plant] {
        m_derived->forget(plant);
        Q_EMIT changed();
    });
    connect(plant, &Plant::updated, this, [this, plant] { m_derived->update(plant); });
}

}  // namespace qplc

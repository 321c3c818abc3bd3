// SPDX-License-Identifier: Apache-2.0
#include "CurveSources.h"

namespace qplc {

CurveSources::CurveSources(PlantList *plants, QObject *parent)
    : QObject(parent)
    , m_plants(plants)
{
    connect(plants, &PlantList::signalsChanged, this, &CurveSources::changed);
    connect(plants, &PlantList::added, this, &CurveSources::follow);
}

CurveSource CurveSources::find(const QString &expression) const
{
    CurveSource source;
    source.title = expression;
    const SignalReference reference = SignalReference::fromString(expression, &source.error);
    if (!reference.isValid())
        return source;
    const PlantList::Signal signal = m_plants->resolve(reference);
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
    if (definition.minimum.isValid())
        source.minimum = definition.minimum.toReal();
    if (definition.maximum.isValid())
        source.maximum = definition.maximum.toReal();
    source.isStepped = !definition.type.isReal();
    return source;
}

void CurveSources::follow(Plant *plant)
{
    connect(plant, &Plant::storeChanged, this, &CurveSources::changed);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "GaugeSource.h"

#include "gui/plant/PastValue.h"
#include "gui/plot/DerivedSignal.h"
#include "gui/plot/Formula.h"

#include <algorithm>

namespace qplc {

GaugeSource::GaugeSource(const QString &text, const PlantList &plants, const CurveSources &formulas, const QString &pin)
{
    if (!Formula::isFormula(text)) {
        m_signal = plants.resolve(SignalReference::fromString(text), pin);
        m_plant = m_signal.plant;
        if (m_signal)
            m_definition = m_signal.definition();
        return;
    }
    m_formula = formulas.find(text, pin);
    m_error = m_formula.error;
    if (!m_formula)
        return;
    m_plant = m_formula.plant;
    m_definition.name = m_formula.title;
    m_definition.type = QPlcSignalType(QPlcSignalType::Real64);
    m_definition.unit = m_formula.unit;
}

const SignalStore *GaugeSource::store() const
{
    return isFormula() ? m_formula.store : m_plant ? m_plant->store() : nullptr;
}

int GaugeSource::channel(int element) const
{
    return isFormula() ? m_formula.channel
                       : m_plant->values().channels().channel(m_signal.index, std::max(element, m_signal.element));
}

QPlcValue GaugeSource::newestValue() const
{
    if (!isFormula())
        return m_signal.value();
    if (!isOfLastCycle() && m_plant->quality() != Plant::Good)
        return m_plant->values().hasValues()
            ? QPlcValue(m_formula.derived->resultOf(m_plant->values().newestChannels()))
            : QPlcValue();
    const SignalStore &rows = *m_formula.store;
    const SignalStore *cycles = m_plant->store();
    // While the past is being calculated, its last row is not the newest one.
    const bool isNow = cycles && !rows.isEmpty() && !cycles->isEmpty()
        && rows.time(rows.endRow() - 1) == cycles->time(cycles->endRow() - 1);
    return isNow ? QPlcValue(double(rows.value(m_formula.channel, rows.endRow() - 1))) : QPlcValue();
}

bool GaugeSource::isOfLastCycle() const
{
    return isFormula() && m_formula.derived->hasPast();
}

QPlcQuality GaugeSource::newestQuality() const
{
    if (!isFormula())
        return m_signal.quality();
    const std::optional<SignalStore::Row> row = m_formula.store->newestRow();
    const int kind = row ? m_formula.store->greatestMark(m_formula.channel, *row, *row + 1) : RowMarks::None;
    return kind == QPlcQuality::Held ? QPlcQuality::held(1) : QPlcQuality(QPlcQuality::Kind(kind));
}

QPlcValue GaugeSource::valueAt(SignalStore::Time time) const
{
    return isFormula() ? pastValue(*m_formula.store, m_formula.channel, time) : pastValue(m_signal, time);
}

bool GaugeSource::isSame(const GaugeSource &other) const
{
    return m_plant == other.m_plant && m_signal.index == other.m_signal.index
        && m_signal.element == other.m_signal.element && m_formula.title == other.m_formula.title;
}

}  // namespace qplc

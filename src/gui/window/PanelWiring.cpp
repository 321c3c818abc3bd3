// SPDX-License-Identifier: Apache-2.0
#include "PanelWiring.h"

#include "QPlcSignalIndexTable.h"
#include "gui/plant/PlantFeed.h"

#include <algorithm>

namespace qplc {

PanelWiring::PanelWiring(WindowContext *context, QObject *parent)
    : QObject(parent)
    , m_context(context)
{
    connect(context->plants(), &PlantList::added, this,
            [this](Plant *plant) { connect(plant, &Plant::updated, this, [this, plant] { deliver(plant); }); });
    connect(context->plants(), &PlantList::signalsChanged, this, &PanelWiring::findPlants);
}

void PanelWiring::add(QPlcWidget *widget)
{
    m_widgets.append(widget);
    findPlants();
    widget->setContext(m_context);
    connect(widget, &QPlcWidget::outputSignalIndicesChanged, this, &PanelWiring::outputsChanged);
    connect(widget, &QPlcWidget::initialOutputSignalsChanged, this, &PanelWiring::initialOutputsChanged);
    connect(widget, &QPlcWidget::sendNewOutputSignals, this,
            [this, widget](const QPlcSignalList &values) { send(*widget, values); });
    if (!widget->outputSignalIndices().isEmpty())
        Q_EMIT outputsChanged();
    if (!widget->initialOutputSignals().isEmpty())
        Q_EMIT initialOutputsChanged();
}

void PanelWiring::remove(QPlcWidget *widget)
{
    widget->disconnect(this);
    if (m_widgets.removeAll(widget) > 0 && !widget->outputSignalIndices().isEmpty())
        Q_EMIT outputsChanged();
}

QPlcSignalIndexList PanelWiring::outputs() const
{
    QPlcSignalIndexList all;
    for (const QPlcWidget *widget : m_widgets) {
        for (const QPlcSignalIndex signal : widget->outputSignalIndices())
            all.insert(signal);
    }
    return all;
}

QPlcSignalList PanelWiring::initialOutputs() const
{
    QPlcSignalList all;
    for (const QPlcWidget *widget : m_widgets) {
        for (const QPlcSignalList::Entry &entry : widget->initialOutputSignals())
            all.insert(entry.index, entry.value);
    }
    return all;
}

void PanelWiring::findPlants()
{
    const QString table = QPlcSignalIndexTable::current().toIni();
    m_plants.clear();
    for (Plant *plant : m_context->plants()->all()) {
        if (plant->feed() || (!plant->table().isEmpty() && plant->table().toIni() == table))
            m_plants.insert(plant);
    }
}

/// Null when the plant of the panel has another table.
Plant *PanelWiring::plantOf(const QPlcWidget &widget) const
{
    Plant *plant = m_context->plants()->plantOf({}, widget.pinnedPlant());
    return m_plants.contains(plant) ? plant : nullptr;
}

void PanelWiring::deliver(Plant *plant)
{
    const bool isWanted = std::any_of(m_widgets.begin(), m_widgets.end(),
                                      [](const QPlcWidget *widget) { return !widget->inputSignalIndices().isEmpty(); });
    if (!isWanted || plant->values().batchSize() == 0)
        return;
    for (QPlcWidget *widget : qAsConst(m_widgets)) {
        if (!widget->inputSignalIndices().isEmpty() && plantOf(*widget) == plant)
            widget->realTimeout(plant->values().batch(widget->inputSignalIndices().toVector()));
    }
}

void PanelWiring::send(const QPlcWidget &widget, const QPlcSignalList &values)
{
    Plant *plant = plantOf(widget);
    if (plant && !plant->feed()) {
        QHash<QString, QPlcValue> byName;
        for (const QPlcSignalList::Entry &entry : values)
            byName.insert(plant->table().at(entry.index).name, entry.value);
        plant->setValues(byName);
        return;
    }
    if (plant || m_context->plants()->size() == 0)  // without a plant the program may send as it likes
        Q_EMIT outputsSent(values);
}

}  // namespace qplc

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
    connect(context->plants(), &PlantList::signalsChanged, this, &PanelWiring::findPlant);
}

void PanelWiring::add(QPlcWidget *widget)
{
    m_widgets.append(widget);
    findPlant();
    widget->setContext(m_context);
    connect(widget, &QPlcWidget::outputSignalIndicesChanged, this, &PanelWiring::outputsChanged);
    connect(widget, &QPlcWidget::initialOutputSignalsChanged, this, &PanelWiring::initialOutputsChanged);
    connect(widget, &QPlcWidget::sendNewOutputSignals, this, &PanelWiring::send);
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

/// Indices of panels are those of the table of the process.
void PanelWiring::findPlant()
{
    const QString table = QPlcSignalIndexTable::current().toIni();
    m_plant = nullptr;
    for (int place = 0; place < m_context->plants()->size() && !m_plant; ++place) {
        Plant *plant = m_context->plants()->at(place);
        if (plant->feed() || (!plant->table().isEmpty() && plant->table().toIni() == table))
            m_plant = plant;
    }
}

void PanelWiring::deliver(Plant *plant)
{
    const bool isWanted = std::any_of(m_widgets.begin(), m_widgets.end(),
                                      [](const QPlcWidget *widget) { return !widget->inputSignalIndices().isEmpty(); });
    if (!isWanted || plant->values().batchSize() == 0 || plant != m_plant)
        return;
    for (QPlcWidget *widget : qAsConst(m_widgets)) {
        if (!widget->inputSignalIndices().isEmpty())
            widget->realTimeout(plant->values().batch(widget->inputSignalIndices().toVector()));
    }
}

void PanelWiring::send(const QPlcSignalList &values)
{
    if (m_plant && !m_plant->feed()) {
        QHash<QString, QPlcValue> byName;
        for (const QPlcSignalList::Entry &entry : values)
            byName.insert(m_plant->table().at(entry.index).name, entry.value);
        m_plant->setValues(byName);
        return;
    }
    Q_EMIT outputsSent(values);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "WindowContext.h"

#include "formulas/Formula.h"
#include "gui/plant/PlantRecording.h"

#include <algorithm>

namespace qplc {

WindowContext::WindowContext(QObject *parent)
    : QObject(parent)
{
    connect(&m_plants, &PlantList::eventOccurred, &m_events, &EventLogModel::append);
    connect(&m_limitAlarms, &LimitAlarms::eventOccurred, &m_events, &EventLogModel::append);
    connect(&m_plants, &PlantList::added, this, &WindowContext::follow);
    connect(&m_plants, &PlantList::removed, this, &WindowContext::renewNewest);
}

WindowContext::~WindowContext()
{
    m_plants.disconnect(this);  // they go after the time view
}

void WindowContext::setTheme(const Theme &theme)
{
    m_theme = theme;
    Q_EMIT themeChanged();
}

QStringList WindowContext::plantsOf(const QStringList &expressions, const QString &pin) const
{
    QStringList names;
    const auto add = [&](const SignalReference &reference) {
        const Plant *selected = m_plants.selected();
        const QString &wanted = reference.plant.isEmpty() ? pin : reference.plant;
        const QString name = !wanted.isEmpty() ? wanted : selected ? selected->name() : QString();
        if (!name.isEmpty() && !names.contains(name))
            names << name;
    };
    for (const QString &expression : expressions) {
        if (!Formula::isFormula(expression)) {
            add(SignalReference::fromString(expression));
            continue;
        }
        const Formula formula = Formula::read(expression, m_plants.names());
        for (const Formula::Operand &operand : formula.operands())
            add(operand.reference);
    }
    return names;
}

void WindowContext::follow(Plant *plant)
{
    connect(plant, &Plant::storeChanged, this, &WindowContext::renewNewest);
    connect(plant, &Plant::updated, this, &WindowContext::renewNewest);
    if (PlantRecording *recording = plant->recording())
        connect(&m_timeAxis, &QPlcTimeAxis::viewChanged, recording,
                [this, recording] { recording->see(m_timeAxis.begin(), m_timeAxis.end()); });
}

/// Of the plants that are there: the one that was ahead may have gone, or begun anew.
void WindowContext::renewNewest()
{
    QPlcTimeAxis::Time newest = 0;
    for (const Plant *plant : m_plants.all())
        newest = std::max<QPlcTimeAxis::Time>(newest, plant->newestTime());
    m_timeAxis.setNewest(newest);
    Q_EMIT valuesChanged();
}

}  // namespace qplc

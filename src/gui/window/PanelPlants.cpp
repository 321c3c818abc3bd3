// SPDX-License-Identifier: Apache-2.0
#include "PanelPlants.h"

#include "QPlcWidget.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"

#include <QtWidgets/QMenu>

#include <algorithm>

namespace qplc {

PanelPlants::PanelPlants(WindowContext *context, QObject *parent)
    : QObject(parent)
    , m_context(context)
{
    PlantList *plants = context->plants();
    for (const auto change : {&PlantList::selectionChanged, &PlantList::signalsChanged})
        connect(plants, change, this, &PanelPlants::showAll);
    connect(plants, &PlantList::added, this, &PanelPlants::showAll);
    connect(plants, &PlantList::removed, this, &PanelPlants::showAll);
    connect(context, &WindowContext::themeChanged, this, &PanelPlants::showAll);
}

void PanelPlants::add(PanelFrame *frame, QPlcWidget *widget)
{
    if (widget->showsAllPlants())
        return;
    frame->setPlantMenu([this, widget](QWidget *parent) { return makeMenu(parent, widget); });
    m_panels.append({frame, widget});
    for (const auto change : {&QPlcWidget::settingsEdited, &QPlcWidget::pinnedPlantChanged})
        connect(widget, change, this, &PanelPlants::showAll);
    showAll();
}

void PanelPlants::showAll()
{
    const auto isGone = [](const Panel &panel) { return !panel.frame || !panel.widget; };
    m_panels.erase(std::remove_if(m_panels.begin(), m_panels.end(), isGone), m_panels.end());
    for (const Panel &panel : qAsConst(m_panels))
        show(panel);
}

QStringList PanelPlants::namesOf(const QPlcWidget &widget) const
{
    const QStringList all = m_context->plants()->names();
    QStringList expressions = widget.shownSignals();
    if (expressions.isEmpty())
        expressions << QString();  // the plant of the panel
    QStringList names = m_context->plantsOf(expressions, widget.pinnedPlant());
    const bool isOnlyOne = all.size() < 2 && (names.isEmpty() || names == all);
    return isOnlyOne ? QStringList() : names;
}

void PanelPlants::show(const Panel &panel) const
{
    const QStringList names = namesOf(*panel.widget);
    const bool isPinned = !panel.widget->pinnedPlant().isEmpty();
    PanelTitleBar::Badge badge;
    if (!names.isEmpty()) {
        const Theme &theme = m_context->theme();
        const Plant *first = names.size() == 1 ? m_context->plants()->find(names.first()) : nullptr;
        badge.text = names.join(QStringLiteral(", "));
        badge.color = first ? theme.plant(first->number()) : theme.mutedText;
        badge.textColor = theme.isDark ? theme.window : QColor(Qt::white);
        badge.toolTip = isPinned ? tr("Pinned to %1. Click to choose another plant.").arg(panel.widget->pinnedPlant())
            : names.size() > 1   ? tr("Signals of %1").arg(badge.text)
                                 : tr("Of %1. Click to choose a plant for this panel.").arg(badge.text);
        badge.isPinned = isPinned;
    }
    panel.frame->titleBar()->setBadge(badge);
}

/// \return null where there is nothing to choose
QMenu *PanelPlants::makeMenu(QWidget *parent, QPlcWidget *widget) const
{
    const QString pinned = widget->pinnedPlant();
    if (m_context->plants()->size() < 2 && pinned.isEmpty())
        return nullptr;
    auto *menu = new QMenu(tr("Plant"), parent);
    const auto addChoice = [&](const QString &text, const QString &plant) {
        QAction *action = menu->addAction(text);
        action->setCheckable(true);
        action->setChecked(plant == pinned);
        connect(action, &QAction::triggered, widget, [widget, plant] {
            if (plant == widget->pinnedPlant())
                return;
            widget->setPinnedPlant(plant);
            Q_EMIT widget->settingsEdited();
        });
    };
    addChoice(tr("The one selected in the bar"), QString());
    menu->addSeparator();
    QStringList names = m_context->plants()->names();
    if (!pinned.isEmpty() && !names.contains(pinned))
        names << pinned;
    for (const QString &name : qAsConst(names))
        addChoice(tr("Pin to %1").arg(name), name);
    return menu;
}

}  // namespace qplc

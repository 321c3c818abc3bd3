// SPDX-License-Identifier: Apache-2.0
#include "SignalPlaceActions.h"

#include "QPlcSignalTree.h"
#include "SignalPlacer.h"
#include "gui/layout/PanelFrame.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/SignalDropArea.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>

namespace qplc {

SignalPlaceActions::SignalPlaceActions(QPlcSignalTree *tree, LayoutView *view, SignalPlacer *placer)
    : QObject(tree)
    , m_tree(tree)
    , m_view(view)
    , m_placer(placer)
{
    add(DropZone::Center, tr("Alt+Return; Alt+Enter"));
    add(DropZone::Area, tr("Alt+Shift+Return; Alt+Shift+Enter"));
    add(DropZone::Left, tr("Alt+Left"));
    add(DropZone::Right, tr("Alt+Right"));
    add(DropZone::Above, tr("Alt+Up"));
    add(DropZone::Below, tr("Alt+Down"));
    add(DropZone::NewTab, tr("T"));
    connect(tree, &QPlcSignalTree::selectionChanged, this, &SignalPlaceActions::update);
    connect(view->editor(), &LayoutEditor::layoutChanged, this, &SignalPlaceActions::update);
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget *, QWidget *now) { follow(now); });
    update();
}

void SignalPlaceActions::add(DropZone zone, const QString &keys)
{
    const auto drop = [this, zone] { m_placer->drop(currentPanel(), zone, m_tree->selectedReferences()); };
    m_actions.insert(zone, addPanelAction(m_tree, {}, QKeySequence::listFromString(keys), drop));
}

QString SignalPlaceActions::currentPanel() const
{
    const Layout &layout = m_view->editor()->layout();
    const LayoutPage *page = layout.pageOf(m_lastPanel);
    if (page && (page->id == layout.currentTab().id || layout.window(page->id)))
        return m_lastPanel;
    std::vector<const LayoutPanel *> panels;
    if (layout.currentTab().tree)
        layout.currentTab().tree->appendPanels(&panels);
    for (const LayoutPanel *panel : panels) {
        if (m_view->widget(panel->id) != m_tree)
            return panel->id;
    }
    return {};
}

void SignalPlaceActions::follow(const QWidget *focus)
{
    for (; focus; focus = focus->parentWidget()) {
        const auto *frame = qobject_cast<const PanelFrame *>(focus);
        if (!frame || frame->widget() == m_tree || m_view->frame(frame->panelId()) != frame)
            continue;
        m_lastPanel = frame->panelId();
        update();
    }
}

void SignalPlaceActions::update()
{
    const LayoutPanel *panel = m_view->editor()->layout().panel(currentPanel());
    const bool hasSignals = !m_tree->selectedReferences().isEmpty();
    const QPlcWidget *widget = panel ? m_view->widget(panel->id) : nullptr;
    const auto *area = widget ? widget->findChild<SignalDropArea *>() : nullptr;
    const QString title = widget ? widget->title() : panel ? panel->title() : QString();
    const QString name = panel ? QLatin1Char('\'') + title + QLatin1Char('\'') : tr("the panel");
    const auto show = [this](DropZone zone, const QString &text, bool isPossible) {
        m_actions.value(zone)->setText(text);
        m_actions.value(zone)->setEnabled(isPossible);
    };
    show(DropZone::Center, panel ? tr("Into %1").arg(name) : tr("Into this tab"), hasSignals);
    show(DropZone::Area, area ? tr("%1 of %2").arg(area->text(), name) : tr("Right axis"), hasSignals && area);
    m_actions.value(DropZone::Area)->setVisible(area);
    show(DropZone::Left, tr("Left of %1").arg(name), hasSignals && panel);
    show(DropZone::Right, tr("Right of %1").arg(name), hasSignals && panel);
    show(DropZone::Above, tr("Above %1").arg(name), hasSignals && panel);
    show(DropZone::Below, tr("Below %1").arg(name), hasSignals && panel);
    show(DropZone::NewTab, tr("Into a new tab"), hasSignals);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
// The context menu of a panel: everything that can be done with it.
#include "PanelFrame.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactory.h"

#include <QtWidgets/QMenu>

namespace qplc {

QMenu *PanelFrame::createMenu()
{
    auto *menu = new QMenu(this);
    if (m_widget)
        addOwnActions(menu);
    addPanelActions(menu);
    return menu;
}

/// What the widget itself can do; in a menu of their own where they are many.
void PanelFrame::addOwnActions(QMenu *menu)
{
    constexpr int most = 8;
    const QList<QAction *> actions = m_widget->actions();
    if (actions.isEmpty())
        return;
    QMenu *place = actions.size() > most ? menu->addMenu(m_type) : menu;
    place->setToolTipsVisible(true);  // why an action is not possible
    for (QAction *action : actions)
        action->setShortcutVisibleInContextMenu(true);
    place->addActions(actions);
    menu->addSeparator();
}

/// A widget with a context menu of its own finds that of the panel as an action "panelMenu" among
/// its children. It is no action of the widget: all that is in it has its keys.
void PanelFrame::offerMenuToWidget()
{
    auto *menu = new QMenu(m_widget);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        qDeleteAll(menu->findChildren<QMenu *>(QString(), Qt::FindDirectChildrenOnly));
        addPanelActions(menu);
    });
    auto *action = new QAction(tr("Panel"), m_widget);
    action->setObjectName(QStringLiteral("panelMenu"));
    action->setMenu(menu);
}

void PanelFrame::addPanelActions(QMenu *menu)
{
    menu->addMenu(createSplitMenu(LayoutSide::Right, tr("Split right"), menu));
    menu->addMenu(createSplitMenu(LayoutSide::Below, tr("Split below"), menu));
    menu->addAction(tr("Duplicate"), this, [this] {
        m_editor->duplicatePanel(m_id, width() >= height() ? LayoutSide::Right : LayoutSide::Below);
    });
    menu->addMenu(createMoveMenu(menu));
    menu->addMenu(createSizeMenu(menu));
    if (QMenu *plants = m_makePlantMenu ? m_makePlantMenu(menu) : nullptr)
        menu->addMenu(plants);
    menu->addSeparator();
    menu->addActions({m_rename, m_settings, m_float, m_maximize});
    menu->addSeparator();
    menu->addAction(m_close);
}

QMenu *PanelFrame::createSplitMenu(LayoutSide side, const QString &text, QWidget *parent)
{
    auto *menu = new QMenu(text, parent);
    menu->addAction(tr("Copy of this panel"), this, [this, side] { m_editor->duplicatePanel(m_id, side); });
    menu->addSeparator();
    for (const QPlcWidgetFactory *factory : qAsConst(m_factories)) {
        const QString type = factory->name();
        menu->addAction(factory->title(), this,
                        [this, type, side] { m_editor->addPanel(type, {}, LayoutTarget::beside(m_id, side)); });
    }
    return menu;
}

QMenu *PanelFrame::createMoveMenu(QWidget *parent)
{
    auto *menu = new QMenu(tr("Move to tab"), parent);
    for (const LayoutTab &tab : m_editor->layout().tabs()) {
        const QString id = tab.id;
        QAction *action
            = menu->addAction(tab.name, this, [this, id] { m_editor->movePanel(m_id, LayoutTarget::inTab(id)); });
        action->setEnabled(m_editor->layout().pageOf(m_id) != &tab);
    }
    menu->addSeparator();
    menu->addAction(tr("New tab"), this, [this] { m_editor->movePanel(m_id, LayoutTarget::inNewTab()); });
    return menu;
}

QMenu *PanelFrame::createSizeMenu(QWidget *parent)
{
    constexpr int Change = LayoutNode::WholeShare / 20;
    auto *menu = new QMenu(tr("Size"), parent);
    const auto add = [&](const QString &text, Qt::Orientation orientation, int change) {
        Layout tried = m_editor->layout();
        menu->addAction(text, this, [this, orientation, change] { m_editor->growPanel(m_id, orientation, change); })
            ->setEnabled(tried.growPanel(m_id, orientation, change));
    };
    add(tr("Wider"), Qt::Horizontal, Change);
    add(tr("Narrower"), Qt::Horizontal, -Change);
    add(tr("Taller"), Qt::Vertical, Change);
    add(tr("Lower"), Qt::Vertical, -Change);
    return menu;
}

}  // namespace qplc

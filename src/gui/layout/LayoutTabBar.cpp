// SPDX-License-Identifier: Apache-2.0
#include "LayoutTabBar.h"

#include "InlineEdit.h"
#include "LayoutIcons.h"
#include "TitleButton.h"
#include "gui/panel/PanelAction.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>

namespace qplc {

namespace {

/// A name as a tab shows it: an ampersand is no mnemonic.
QString shownName(QString name)
{
    return name.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

}  // namespace

LayoutTabBar::LayoutTabBar(LayoutEditor *editor, QWidget *parent)
    : QTabBar(parent)
    , m_editor(editor)
{
    setAccessibleName(tr("Tabs"));
    setDocumentMode(true);
    setDrawBase(false);
    setExpanding(false);
    setMovable(true);
    setElideMode(Qt::ElideRight);
    setChangeCurrentOnDrag(true);
    setFocusPolicy(Qt::StrongFocus);
    makeActions();
    connect(this, &QTabBar::currentChanged, this, [this](int index) {
        if (!m_isFollowing)
            m_editor->setCurrentTab(tabId(index));
    });
    connect(this, &QTabBar::tabMoved, this, &LayoutTabBar::takeMove);
}

void LayoutTabBar::makeActions()
{
    const auto add = [this](const QString &text, const QString &keys, const std::function<void()> &act) {
        addPanelAction(this, text, {keys}, act, "", Qt::WidgetShortcut);
    };
    add(tr("Rename tab"), tr("F2"), [this] { startRename(currentIndex()); });
    add(tr("Move tab left"), tr("Ctrl+Shift+Left"),
        [this] { m_editor->moveTab(tabId(currentIndex()), currentIndex() - 1); });
    add(tr("Move tab right"), tr("Ctrl+Shift+Right"),
        [this] { m_editor->moveTab(tabId(currentIndex()), currentIndex() + 1); });
    add(tr("Close tab"), tr("Ctrl+W"), [this] { m_editor->closeTab(tabId(currentIndex())); });
}

int LayoutTabBar::indexOf(const QString &id) const
{
    for (int i = 0; i < count(); ++i) {
        if (tabId(i) == id)
            return i;
    }
    return -1;
}

void LayoutTabBar::addTabOf(const LayoutTab &tab, int index)
{
    const QString id = tab.id;
    setTabData(insertTab(index, shownName(tab.name)), id);
    auto *close = new TitleButton(this);
    close->setIcon(layoutIcon(LayoutIcon::Close));
    close->setToolTip(tr("Close tab"));
    close->setIconSize({10, 10});
    close->setFocusPolicy(Qt::NoFocus);  // keys: Ctrl+W
    connect(close, &QToolButton::clicked, this, [this, id] { m_editor->closeTab(id); });
    setTabButton(index, QTabBar::RightSide, close);
}

void LayoutTabBar::takeMove(int from, int to)
{
    if (m_isFollowing)
        return;
    // While a tab is dragged over another one, QTabBar says that the other one moves: the dragged
    // one is the current one.
    const bool isOther = qAbs(from - to) == 1 && currentIndex() == from;
    const int moved = isOther ? from : to;
    m_editor->moveTab(tabId(moved), moved);
}

void LayoutTabBar::showTabs(const Layout &layout)
{
    m_isFollowing = true;
    for (int i = count() - 1; i >= 0; --i) {
        if (!layout.tab(tabId(i)))
            removeTab(i);
    }
    int index = 0;
    for (const LayoutTab &tab : layout.tabs()) {
        const int present = indexOf(tab.id);
        if (present < 0)
            addTabOf(tab, index);
        else if (present != index)
            QTabBar::moveTab(present, index);
        if (tabText(index) != shownName(tab.name))
            setTabText(index, shownName(tab.name));
        tabButton(index, QTabBar::RightSide)->setAccessibleName(tr("Close tab %1").arg(tab.name));
        ++index;
    }
    setCurrentIndex(indexOf(layout.currentTab().id));
    m_isFollowing = false;
    updateGeometry();  // a QTabBar that is hidden tells nobody that it wants another width
}

QString LayoutTabBar::tabIdAt(const QPoint &position) const
{
    return tabId(tabAt(position));
}

void LayoutTabBar::startRename(int index)
{
    if (index < 0)
        return;
    const QString id = tabId(index);
    auto *edit = new InlineEdit(m_editor->layout().tab(id)->name, tabRect(index).adjusted(2, 2, -2, -2), this);
    connect(edit, &InlineEdit::accepted, this, [this, id](const QString &name) { m_editor->renameTab(id, name); });
}

void LayoutTabBar::mouseDoubleClickEvent(QMouseEvent *event)
{
    if (event->button() == Qt::LeftButton)
        startRename(tabAt(event->pos()));
}

void LayoutTabBar::contextMenuEvent(QContextMenuEvent *event)
{
    if (event->reason() == QContextMenuEvent::Mouse && tabAt(event->pos()) >= 0)
        setCurrentIndex(tabAt(event->pos()));
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addActions(actions());
    menu->addSeparator();
    menu->addAction(tr("New tab"), this, [this] { m_editor->addTab(); });
    const bool isKeyboard = event->reason() == QContextMenuEvent::Keyboard;
    menu->popup(isKeyboard ? mapToGlobal(tabRect(currentIndex()).bottomLeft()) : event->globalPos());
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "PanelDrag.h"

#include "FloatingWindow.h"
#include "LayoutTabBar.h"
#include "LayoutView.h"
#include "PageView.h"
#include "PanelFrame.h"

#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QToolButton>

namespace qplc {

namespace {

bool contains(const QWidget *widget, const QPoint &globalPosition)
{
    return widget->isVisible() && widget->rect().contains(widget->mapFromGlobal(globalPosition));
}

}  // namespace

PanelDrag::PanelDrag(LayoutView *view)
    : QObject(view)
    , m_view(view)
{
}

PanelDrag::~PanelDrag()
{
    delete m_overlay;
}

PanelDrag::Place PanelDrag::placeAt(const QString &panelId, const QPoint &globalPosition) const
{
    const Layout &layout = m_view->editor()->layout();
    // Floating windows are above the main one; the one that is being emptied is no place.
    for (FloatingWindow *each : qAsConst(m_view->m_windows)) {
        const bool isEmptied
            = layout.pageOf(panelId)->id == each->windowId() && layout.window(each->windowId())->tree->isPanel();
        if (!isEmptied && contains(each, globalPosition))
            return placeIn(each, panelId, globalPosition);
    }
    if (contains(m_view->tabBar(), globalPosition))
        return placeInTabs(panelId, globalPosition);
    if (contains(m_view->m_add, globalPosition))
        return {m_view->m_add, m_view->m_add->rect(), LayoutTarget::inNewTab()};
    if (contains(m_view, globalPosition))
        return placeIn(m_view->m_stack, panelId, globalPosition);
    // Beside the view, but in its window: bars of others, where nothing can stand.
    return {contains(m_view->window(), globalPosition) ? m_view->window() : nullptr, {}, {}};
}

PanelDrag::Place PanelDrag::placeInTabs(const QString &panelId, const QPoint &globalPosition) const
{
    LayoutTabBar *bar = m_view->tabBar();
    const QPoint position = bar->mapFromGlobal(globalPosition);
    const QString tab = bar->tabIdAt(position);
    if (tab.isEmpty() || m_view->editor()->layout().pageOf(panelId)->id == tab)
        return {bar, {}, {}};
    return {bar, bar->tabRect(bar->tabAt(position)), LayoutTarget::inTab(tab)};
}

PanelDrag::Place PanelDrag::placeIn(QWidget *window, const QString &panelId, const QPoint &globalPosition) const
{
    for (PanelFrame *frame : qAsConst(m_view->m_frames)) {
        if (!window->isAncestorOf(frame) || !contains(frame, globalPosition))
            continue;
        if (frame->panelId() == panelId)
            return {frame, {}, {}};
        const DropZone zone
            = dropZoneAt(frame->rect(), frame->mapFromGlobal(globalPosition), DropCenter::BelongsToTheNearestEdge);
        return {frame, dropZoneRect(frame->rect(), zone), LayoutTarget::beside(frame->panelId(), LayoutSide(zone))};
    }
    const LayoutTab &tab = m_view->editor()->layout().currentTab();
    if (window == m_view->m_stack && !tab.tree)
        return {window, window->rect(), LayoutTarget::inTab(tab.id)};
    return {window, {}, {}};
}

void PanelDrag::move(const QString &panelId, const QPoint &globalPosition)
{
    if (!m_view->editor()->layout().panel(panelId))
        return cancel();
    const Place place = placeAt(panelId, globalPosition);
    if (!place.target)
        return cancel();
    if (!m_overlay)
        m_overlay = new DropOverlay;
    m_overlay->showOver(place.widget, place.rect);
}

void PanelDrag::finish(const QString &panelId, const QPoint &globalPosition)
{
    cancel();
    if (!m_view->editor()->layout().panel(panelId))
        return;
    const Place place = placeAt(panelId, globalPosition);
    if (place.target)
        m_view->editor()->movePanel(panelId, *place.target);
    else if (!place.widget)
        putIntoWindow(panelId, globalPosition);
}

void PanelDrag::putIntoWindow(const QString &panelId, const QPoint &globalPosition)
{
    LayoutEditor *editor = m_view->editor();
    const auto *page = editor->layout().pageOf(panelId);
    const QPoint hand(40, 12);  // stays on the title bar
    if (const LayoutWindow *window = editor->layout().window(page->id); window && window->tree->isPanel())
        editor->setWindowGeometry(page->id, QRect(globalPosition - hand, window->geometry.size()));
    else
        editor->floatPanel(panelId,
                           QRect(globalPosition - hand, m_view->frame(panelId)->size().expandedTo({320, 220})));
}

void PanelDrag::cancel()
{
    if (m_overlay)
        m_overlay->hide();
}

}  // namespace qplc

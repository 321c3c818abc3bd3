// SPDX-License-Identifier: Apache-2.0
#include "TabDrop.h"

#include "LayoutEditor.h"
#include "LayoutTabBar.h"
#include "gui/SignalsMimeType.h"

#include <QtCore/QMimeData>
#include <QtGui/QDragMoveEvent>

namespace qplc {

TabDrop::TabDrop(LayoutTabBar *bar, QWidget *newTab, LayoutEditor *editor)
    : QObject(bar)
    , m_bar(bar)
    , m_newTab(newTab)
    , m_editor(editor)
{
    for (QWidget *each : {static_cast<QWidget *>(bar), newTab}) {
        each->setAcceptDrops(true);
        each->installEventFilter(this);
    }
}

TabDrop::~TabDrop()
{
    delete m_overlay;
}

void TabDrop::hideOverlay()
{
    if (m_overlay)
        m_overlay->hide();
}

void TabDrop::move(QWidget *over, QDragMoveEvent *event)
{
    const QString tab = over == m_bar ? m_bar->tabIdAt(event->pos()) : QString();
    if (over == m_bar && tab.isEmpty()) {
        hideOverlay();
        event->ignore();
        return;
    }
    if (over == m_bar)
        m_editor->setCurrentTab(tab);
    if (!m_overlay)
        m_overlay = new DropOverlay;
    m_overlay->showOver(over, over == m_bar ? m_bar->tabRect(m_bar->tabAt(event->pos())) : over->rect());
    event->acceptProposedAction();
}

bool TabDrop::eventFilter(QObject *watched, QEvent *event)
{
    auto *over = static_cast<QWidget *>(watched);
    switch (event->type()) {
    case QEvent::DragEnter:
    case QEvent::DragMove:
        if (auto *drag = static_cast<QDragMoveEvent *>(event); drag->mimeData()->hasFormat(signalsMimeType())) {
            move(over, drag);
            return true;
        }
        break;
    case QEvent::DragLeave:
        hideOverlay();
        break;
    case QEvent::Drop:
        if (auto *drop = static_cast<QDropEvent *>(event); drop->mimeData()->hasFormat(signalsMimeType())) {
            hideOverlay();
            drop->acceptProposedAction();
            Q_EMIT signalsDropped(over == m_newTab ? DropZone::NewTab : DropZone::Center, drop->mimeData());
            return true;
        }
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "LongPress.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QApplication>
#include <QtWidgets/QWidget>

namespace qplc {

void LongPress::watch()
{
    static QPointer<LongPress> watcher;
    if (!watcher)
        watcher = new LongPress(qApp);
}

LongPress::LongPress(QObject *parent)
    : QObject(parent)
{
    m_timer.setSingleShot(true);
    m_timer.setInterval(Delay);
    connect(&m_timer, &QTimer::timeout, this, &LongPress::openMenu);
    qApp->installEventFilter(this);
}

bool LongPress::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        if (watched->isWidgetType())
            press(static_cast<QWidget *>(watched), *static_cast<QMouseEvent *>(event));
        break;
    case QEvent::MouseMove:
        if (m_timer.isActive()
            && (static_cast<QMouseEvent *>(event)->globalPos() - m_place).manhattanLength()
                >= QApplication::startDragDistance())
            m_timer.stop();
        break;
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
        m_timer.stop();
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

void LongPress::press(QWidget *widget, const QMouseEvent &event)
{
    const bool isFinger = event.source() != Qt::MouseEventNotSynthesized && event.button() == Qt::LeftButton;
    if (!isFinger) {
        m_timer.stop();
        return;
    }
    if (m_timer.isActive())
        return;  // the same press, on its way to the parents of the widget
    m_pressed = widget;
    m_place = event.globalPos();
    m_timer.start();
}

void LongPress::openMenu()
{
    if (!m_pressed)
        return;
    // What was pressed is let go beside it: a button is not clicked, a drag does not begin.
    const QPoint outside(-1, -1);
    QMouseEvent release(QEvent::MouseButtonRelease, outside, m_pressed->mapToGlobal(outside), Qt::LeftButton,
                        Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(m_pressed, &release);
    if (!m_pressed)
        return;
    QContextMenuEvent menu(QContextMenuEvent::Mouse, m_pressed->mapFromGlobal(m_place), m_place);
    QApplication::sendEvent(m_pressed, &menu);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "DragEscape.h"

#include <QtCore/QCoreApplication>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QWidget>

namespace qplc {

DragEscape::DragEscape(QWidget *widget, QObject *parent)
    : QObject(parent)
{
    watch(widget);
}

void DragEscape::watch(QWidget *widget)
{
    m_widgets.append(widget);
    widget->installEventFilter(this);
}

/// Of the widgets, and of the application while a button is down.
bool DragEscape::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseMove:
    case QEvent::Hide:
        return m_widgets.contains(watched) && hearMouse(*event);
    case QEvent::ShortcutOverride:
        if (m_isPressed && static_cast<QKeyEvent *>(event)->key() == Qt::Key_Escape)
            event->accept();
        return false;  // others hear that there was a press
    case QEvent::KeyPress:
        if (!m_isPressed || static_cast<QKeyEvent *>(event)->key() != Qt::Key_Escape)
            break;
        listenToKeys(false);
        Q_EMIT escaped();
        m_isOver = true;  // also if the widget was told that the button is up
        return true;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

bool DragEscape::hearMouse(const QEvent &event)
{
    if (event.type() == QEvent::MouseMove)
        return m_isOver;
    listenToKeys(event.type() == QEvent::MouseButtonPress);
    m_isOver = false;
    return false;
}

void DragEscape::listenToKeys(bool listens)
{
    if (listens == m_isPressed)
        return;
    m_isPressed = listens;
    if (listens)
        QCoreApplication::instance()->installEventFilter(this);
    else
        QCoreApplication::instance()->removeEventFilter(this);
}

void sendRelease(QWidget *widget)
{
    QMouseEvent release(QEvent::MouseButtonRelease, QPointF(-1, -1), Qt::LeftButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &release);
}

}  // namespace qplc

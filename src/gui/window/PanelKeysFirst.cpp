// SPDX-License-Identifier: Apache-2.0
#include "PanelKeysFirst.h"

#include <QtGui/QShortcutEvent>
#include <QtWidgets/QApplication>

namespace qplc {

namespace {

bool canRun(const QAction *action, const QKeySequence &keys)
{
    return action->isEnabled() && action->isVisible() && action->shortcuts().contains(keys);
}

/// \param isFocus  whether the widget itself has the focus
bool isHeard(const QAction *action, bool isFocus)
{
    return isFocus || action->shortcutContext() != Qt::WidgetShortcut;
}

}  // namespace

PanelKeysFirst::PanelKeysFirst(QObject *parent)
    : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

QAction *PanelKeysFirst::firstWith(const QKeySequence &keys)
{
    QAction *first = nullptr;
    QWidget *const focus = QApplication::focusWidget();
    for (QWidget *widget = focus; widget; widget = widget->parentWidget()) {
        for (QAction *action : widget->actions()) {
            if (!canRun(action, keys) || !isHeard(action, widget == focus))
                continue;
            if (action->shortcutContext() == Qt::ApplicationShortcut)
                return action;
            if (!first)
                first = action;
        }
    }
    return first;
}

bool PanelKeysFirst::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::Shortcut || !qobject_cast<QAction *>(watched))
        return QObject::eventFilter(watched, event);
    const auto *shortcut = static_cast<const QShortcutEvent *>(event);
    QAction *const first = shortcut->isAmbiguous() ? firstWith(shortcut->key()) : nullptr;
    if (!first)
        return QObject::eventFilter(watched, event);
    first->trigger();
    return true;
}

}  // namespace qplc

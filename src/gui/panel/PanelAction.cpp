// SPDX-License-Identifier: Apache-2.0
#include "PanelAction.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QWidget>

namespace qplc {

QAction *addPanelAction(QWidget *widget, const QString &text, const QList<QKeySequence> &keys,
                        const std::function<void()> &act, const char *name, Qt::ShortcutContext context)
{
    auto *action = new QAction(text, widget);
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(keys);
    action->setShortcutContext(context);
    QObject::connect(action, &QAction::triggered, widget, act);
    widget->addAction(action);
    return action;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "ChartAction.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QWidget>

namespace qplc {

QAction *addChartAction(QWidget *panel, const QString &text, const QList<QKeySequence> &keys, const char *name,
                        std::function<void()> act)
{
    auto *action = new QAction(text, panel);
    action->setObjectName(QLatin1String(name));
    action->setShortcuts(keys);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    QObject::connect(action, &QAction::triggered, panel, std::move(act));
    panel->addAction(action);
    return action;
}

}  // namespace qplc

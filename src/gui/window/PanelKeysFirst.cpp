// SPDX-License-Identifier: Apache-2.0
#include "PanelKeysFirst.h"

#include <QtWidgets/QApplication>

#include <algorithm>

namespace qplc {

PanelKeysFirst::PanelKeysFirst(QWidget *window)
    : QObject(window)
    , m_window(window)
{
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget *, QWidget *now) { follow(now); });
}

QSet<QString> PanelKeysFirst::keysOfPanel(QWidget *focused) const
{
    QSet<QString> keys;
    for (QWidget *widget = focused; widget && widget != m_window; widget = widget->parentWidget()) {
        for (const QAction *action : widget->actions()) {
            const bool isOfWidget = action->shortcutContext() == Qt::WidgetWithChildrenShortcut
                || (action->shortcutContext() == Qt::WidgetShortcut && widget == focused);
            for (const QKeySequence &sequence : action->shortcuts()) {
                if (isOfWidget && action->isEnabled())
                    keys.insert(sequence.toString());
            }
        }
    }
    return keys;
}

void PanelKeysFirst::follow(QWidget *focused)
{
    const QSet<QString> keys = keysOfPanel(focused);
    for (QAction *action : m_window->actions()) {
        if (action->shortcutContext() == Qt::ApplicationShortcut)
            continue;  // STOP gives way to nobody
        const QList<QKeySequence> all = action->shortcuts();
        const bool isTaken = std::any_of(all.begin(), all.end(),
                                         [&](const QKeySequence &each) { return keys.contains(each.toString()); });
        // The window itself never has the focus, so keys of that context do nothing.
        action->setShortcutContext(isTaken ? Qt::WidgetShortcut : Qt::WindowShortcut);
    }
}

}  // namespace qplc

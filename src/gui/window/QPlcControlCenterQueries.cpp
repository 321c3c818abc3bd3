// SPDX-License-Identifier: Apache-2.0
// What programs ask of the window that nobody looks at: a demo, a screenshot.
#include "QPlcControlCenterPrivate.h"

#include <QtWidgets/QMenu>

using namespace qplc;

bool QPlcControlCenter::isLive(const QString &plant) const
{
    const Plant *found = context()->plants()->find(plant);
    return found && found->quality() == Plant::Good;
}

bool QPlcControlCenter::showTab(const QString &name)
{
    for (const LayoutTab &tab : d->editor.layout().tabs()) {
        if (tab.name == name) {
            d->editor.setCurrentTab(tab.id);
            return true;
        }
    }
    return false;
}

void QPlcControlCenter::addHelpAction(QAction *action)
{
    d->actions->helpMenu->addAction(action);
    addAction(action);
}

void QPlcControlCenter::showHint(const QString &text, QAction *remedy)
{
    d->hint->showText(text, remedy);
}

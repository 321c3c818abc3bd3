// SPDX-License-Identifier: Apache-2.0
// What programs ask of the window that nobody looks at: a demo, a screenshot.
#include "QPlcControlCenterPrivate.h"

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

void QPlcControlCenter::showHint(const QString &text, QAction *remedy)
{
    d->hint->showText(text, remedy);
}

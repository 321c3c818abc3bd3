// SPDX-License-Identifier: Apache-2.0
// What programs ask of the window that nobody looks at: a demo, a screenshot.
#include "QPlcControlCenter.h"
#include "gui/layout/LayoutView.h"
#include "gui/panel/WindowContext.h"

using namespace qplc;

bool QPlcControlCenter::isLive(const QString &plant) const
{
    const Plant *found = context()->plants()->find(plant);
    return found && found->quality() == Plant::Good;
}

bool QPlcControlCenter::showTab(const QString &name)
{
    LayoutEditor *editor = findChild<LayoutView *>()->editor();
    for (const LayoutTab &tab : editor->layout().tabs()) {
        if (tab.name == name) {
            editor->setCurrentTab(tab.id);
            return true;
        }
    }
    return false;
}

void QPlcControlCenter::showHint(const QString &text, QAction *remedy)
{
    showHint(text);
    Q_UNUSED(remedy)
}

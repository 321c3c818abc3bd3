// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/PanelAction.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QLineEdit>

namespace qplc {

/// Escape in a search line with a text removes the text and goes to the rows. Without a text the
/// key stays free for others.
inline void leaveByEscape(QLineEdit *search, QWidget *rows)
{
    const auto clear = [search, rows] {
        search->clear();
        rows->setFocus(Qt::OtherFocusReason);
    };
    QAction *leave = addPanelAction(search, {}, {Qt::Key_Escape}, clear, "", Qt::WidgetShortcut);
    leave->setEnabled(!search->text().isEmpty());
    QObject::connect(search, &QLineEdit::textChanged, leave,
                     [leave](const QString &text) { leave->setEnabled(!text.isEmpty()); });
}

}  // namespace qplc

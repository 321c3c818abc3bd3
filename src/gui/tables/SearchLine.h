// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QAction>
#include <QtWidgets/QLineEdit>

namespace qplc {

/// Escape in a search line with a text removes the text and goes to the rows. Without a text the
/// key stays free for others.
inline void leaveByEscape(QLineEdit *search, QWidget *rows)
{
    auto *leave = new QAction(search);
    leave->setShortcut(QKeySequence(Qt::Key_Escape));
    leave->setShortcutContext(Qt::WidgetShortcut);
    leave->setEnabled(!search->text().isEmpty());
    search->addAction(leave);
    QObject::connect(search, &QLineEdit::textChanged, leave,
                     [leave](const QString &text) { leave->setEnabled(!text.isEmpty()); });
    QObject::connect(leave, &QAction::triggered, rows, [search, rows] {
        search->clear();
        rows->setFocus(Qt::OtherFocusReason);
    });
}

}  // namespace qplc

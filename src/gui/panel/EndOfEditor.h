// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLineEdit>

namespace qplc {

/// For the destructor of an editor of settings: the line that has the focus loses it, and says so, only when the settings of the editor are no more. It must not write them then.
inline void disconnectLines(QWidget *editor)
{
    const QList<QLineEdit *> lines = editor->findChildren<QLineEdit *>();
    for (QLineEdit *line : lines)
        line->disconnect(editor);
}

}  // namespace qplc

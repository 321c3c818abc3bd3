// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QList>
#include <QtGui/QKeySequence>

#include <functional>

class QAction;
class QWidget;

namespace qplc {

/// A new action of a panel or a part of one, which owns it. Its keys work while the focus is in the
/// widget. \param name  by which menus find it
/// \param context  Qt::WidgetShortcut: while the widget itself has the focus
QAction *addPanelAction(QWidget *widget, const QString &text, const QList<QKeySequence> &keys,
                        const std::function<void()> &act, const char *name = "",
                        Qt::ShortcutContext context = Qt::WidgetWithChildrenShortcut);

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QList>
#include <QtGui/QKeySequence>

#include <functional>

class QAction;
class QWidget;

namespace qplc {

/// A new action of a panel, which owns it. Its keys work while the focus is in the panel.
/// \param name  by which menus find it
QAction *addChartAction(QWidget *panel, const QString &text, const QList<QKeySequence> &keys, const char *name,
                        std::function<void()> act);

}  // namespace qplc

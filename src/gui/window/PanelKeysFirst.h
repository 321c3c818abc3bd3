// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QAction>

namespace qplc {

/// Of several actions with the same keys, that of the innermost widget around the focus runs: of a
/// panel before that of the tabs, and both before that of the window. Qt alone would run none of
/// them. Only what works everywhere (STOP) gives way to nobody.
class PanelKeysFirst : public QObject
{
    Q_OBJECT
public:
    /// Listens to all keys of the program that mean two things.
    explicit PanelKeysFirst(QObject *parent);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    static QAction *firstWith(const QKeySequence &keys);
};

}  // namespace qplc

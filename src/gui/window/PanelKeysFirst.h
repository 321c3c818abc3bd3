// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QSet>
#include <QtWidgets/QAction>

namespace qplc {

/// The keys of the panel with the focus win over the same keys of the window: while it has the focus, a key never means two things.
class PanelKeysFirst : public QObject
{
    Q_OBJECT
public:
    /// \param window  its actions() give way; it owns this object
    explicit PanelKeysFirst(QWidget *window);

private:
    void follow(QWidget *focused);
    QSet<QString> keysOfPanel(QWidget *focused) const;

    QWidget *m_window;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QDockWidget>

class QPlcSignalTree;

namespace qplc {

class WindowContext;

/// The tree of signals at the side of the window.
class SignalDock : public QDockWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the dock
    explicit SignalDock(WindowContext *context, QWidget *parent = nullptr);

    QPlcSignalTree *tree() const { return m_tree; }
    void startSearch();

private:
    QWidget *createTitle();

    QPlcSignalTree *m_tree;
};

}  // namespace qplc

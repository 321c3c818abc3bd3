// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QDockWidget>

class QLineEdit;
class QTreeView;

namespace qplc {

class SignalFilterModel;
class SignalTreeModel;

/// All signals of all plants at the edge of the window, with a search: drag them out, or plot, gauge or watch the selected ones with a key.
class SignalDock : public QDockWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the dock
    explicit SignalDock(WindowContext *context, QWidget *parent = nullptr);

    QTreeView *tree() const { return m_tree; }
    QLineEdit *searchLine() const { return m_search; }
    /// What is done with the selected signals, for menus and the palette of commands.
    QList<QAction *> signalActions() const { return m_signalActions; }
    QStringList selectedReferences() const;
    void startSearch();

Q_SIGNALS:
    /// \param type  of the panel: "Time plot", "Gauge", "Value table"
    void panelRequested(const QString &type, const QStringList &references);

private:
    void makeTree();
    void makeActions();

    SignalTreeModel *m_model;
    SignalFilterModel *m_filter;
    QLineEdit *m_search;
    QTreeView *m_tree;
    QList<QAction *> m_signalActions;
};

}  // namespace qplc

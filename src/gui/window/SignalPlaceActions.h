// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/DropZone.h"

#include <QtCore/QMap>
#include <QtCore/QObject>

class QAction;
class QPlcSignalTree;

namespace qplc {

class LayoutView;
class SignalPlacer;

/// What a mouse does by dragging signals of a tree, as actions of the tree: into the current panel,
/// to a side of it, into a new tab.
///
/// The current panel is the one that had the keyboard last, else the first one of the tab; the
/// actions say its name.
class SignalPlaceActions : public QObject
{
    Q_OBJECT
public:
    /// \param tree  owns this object; the others outlive it
    SignalPlaceActions(QPlcSignalTree *tree, LayoutView *view, SignalPlacer *placer);

    /// Empty: there is none.
    QString currentPanel() const;

private:
    void add(DropZone zone, const QString &keys);
    void follow(const QWidget *focus);
    void update();

    QPlcSignalTree *m_tree;
    LayoutView *m_view;
    SignalPlacer *m_placer;
    QMap<DropZone, QAction *> m_actions;
    QString m_lastPanel;  // that had the keyboard
};

}  // namespace qplc

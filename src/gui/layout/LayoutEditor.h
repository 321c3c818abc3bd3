// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Layout.h"

#include <QtCore/QObject>
#include <QtWidgets/QUndoStack>

#include <functional>

namespace qplc {

/// The layout of a window, and what a person did to it: every edit is a step that undoes and
/// redoes, with a text for the menu ("move of 'Time plot'").
///
/// Edits have the preconditions of Layout; those that fail, or change nothing, are no steps.
/// Successive resizes of one split, moves of one tab and settings of one panel are one step. What
/// is looked at (the current tab, the place of windows) is no step; undoing brings the tab to the
/// front where something happens, and leaves windows where they are.
///
/// Threads: that of the window.
class LayoutEditor : public QObject
{
    Q_OBJECT
public:
    explicit LayoutEditor(QObject *parent = nullptr);
    explicit LayoutEditor(const Layout &layout, QObject *parent = nullptr);

    const Layout &layout() const { return m_layout; }
    /// Takes another layout, say of a file; there is nothing to undo then.
    void setLayout(const Layout &layout);
    /// Takes another layout as one step that can be undone: \a text for the menu, such as "reset of
    /// the layout".
    bool replace(const Layout &layout, const QString &text);
    /// What was done and what comes are never one step.
    void separateSteps() { ++m_series; }
    QUndoStack *undoStack() { return &m_stack; }
    /// What people call a panel, on its title bar, on the window that it floats in, and where steps
    /// are undone: what \a titles says, else LayoutPanel::title().
    QString titleOf(const QString &panelId) const;
    /// Says what is in a panel; empty: it does not know.
    void setTitles(const std::function<QString(const QString &panelId)> &titles) { m_titles = titles; }

    QString addPanel(const QString &type, const QJsonObject &settings, const LayoutTarget &target);
    QString duplicatePanel(const QString &panelId, LayoutSide side);
    bool closePanel(const QString &panelId);
    bool movePanel(const QString &panelId, const LayoutTarget &target);
    bool floatPanel(const QString &panelId, const QRect &geometry);
    bool dockPanel(const QString &panelId);
    bool setMaximized(const QString &panelId, bool isMaximized);
    bool setPanelSettings(const QString &panelId, const QJsonObject &settings);
    bool setPanelTitle(const QString &panelId, const QString &title);
    bool setShares(const LayoutSpan &split, const QVector<int> &shares);
    bool growPanel(const QString &panelId, Qt::Orientation orientation, int change);

    QString addTab(const QString &name = {});
    bool closeTab(const QString &tabId);
    bool renameTab(const QString &tabId, const QString &name);
    bool moveTab(const QString &tabId, int index);
    bool closeWindow(const QString &windowId);

    void setCurrentTab(const QString &tabId);
    void setWindowGeometry(const QString &windowId, const QRect &geometry);

Q_SIGNALS:
    void layoutChanged();
    /// Why a panel was not added, as a sentence.
    void refused(const QString &sentence);

private:
    class Step;
    enum MergeKind { NoMerge = -1, Resizes = 1, TabMoves, Settings };

    /// Successive steps of one kind and key are one.
    struct Merge
    {
        MergeKind kind = NoMerge;
        QString key{};
    };

    bool push(const Layout &after, const QString &text, const Merge &merge);
    /// One of the edits of Layout, with its arguments.
    template<typename... Parameters, typename... Arguments>
    bool edit(bool (Layout::*change)(Parameters...), const QString &text, const Merge &merge,
              const Arguments &...arguments);
    bool hasRoom();
    void show(const Layout &from, const Layout &to);
    QString quotedTab(const QString &tabId) const;

    Layout m_layout;
    std::function<QString(const QString &)> m_titles;
    int m_series = 0;
    QUndoStack m_stack;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutTarget.h"

namespace qplc {

/// What tabs and floating windows have in common: a tree of panels.
struct LayoutPage
{
    QString id;                      // unique in a layout: "tab1", "window2"
    std::optional<LayoutNode> tree;  // none: empty
    QString maximized;               // the one panel that is shown; empty: all are
    QJsonObject otherKeys;
};

struct LayoutTab : LayoutPage
{
    QString name;
};

/// Where a floating panel came from, to go back there.
struct LayoutHome
{
    QString tab;
    LayoutSpan beside;  // empty: it was alone
    LayoutSide side = LayoutSide::Right;
    int share = LayoutNode::WholeShare;
    QJsonObject otherKeys;
};

/// A window of its own; never empty.
struct LayoutWindow : LayoutPage
{
    QRect geometry;
    QJsonObject otherGeometryKeys;
    std::optional<LayoutHome> home;  // of its panel, while it is the only one
};

/// The arrangement of panels in tabs, splits and floating windows: a plain value.
///
/// An edit changes the value and returns true, or, where its precondition (the things that it names
/// exist, texts are not empty) fails, returns false and has changed nothing. After each edit
/// invariantError() is empty. There is at least one tab.
///
/// Threads: as any value.
class Layout
{
public:
    static constexpr int MostPanels
        = 500;  // a file with more panels, tabs or splits is refused: a window cannot show them in time

    Layout();

    const std::vector<LayoutTab> &tabs() const { return m_tabs; }
    const std::vector<LayoutWindow> &windows() const { return m_windows; }
    const LayoutTab &currentTab() const;
    /// Null when there is none.
    const LayoutPanel *panel(const QString &panelId) const;
    /// The tab or window with this panel; null when there is none.
    const LayoutPage *pageOf(const QString &panelId) const;
    const LayoutTab *tab(const QString &tabId) const;
    const LayoutWindow *window(const QString &windowId) const;
    /// In the order of tabs and windows, from left to right and from above to below.
    std::vector<const LayoutPanel *> panels() const;
    bool isFloating(const QString &panelId) const;

    /// Whether there are as many panels as there may be.
    bool isFull() const { return panels().size() >= MostPanels; }

    /// Adds a panel of this type, and shows it. \return its id; empty when there is no such target,
    /// or isFull()
    QString addPanel(const QString &type, const QJsonObject &settings, const LayoutTarget &target);
    /// Adds a copy of a panel beside it.
    QString duplicatePanel(const QString &panelId, LayoutSide side);
    bool closePanel(const QString &panelId);
    /// False also where the panel would be beside itself.
    bool movePanel(const QString &panelId, const LayoutTarget &target);
    /// Moves a panel into a window of its own, which knows where it came from.
    bool floatPanel(const QString &panelId, const QRect &geometry);
    /// Moves a floating panel to where it came from, or else to the current tab.
    bool dockPanel(const QString &panelId);
    bool setMaximized(const QString &panelId, bool isMaximized);
    bool setPanelSettings(const QString &panelId, const QJsonObject &settings);
    /// Empty: the type is the title.
    bool setPanelTitle(const QString &panelId, const QString &title);
    /// \param shares  one for each child of the split, > 0, scaled to LayoutNode::WholeShare
    bool setShares(const LayoutSpan &split, const QVector<int> &shares);
    /// Gives a panel more or less of the next split of this orientation around it; the others share
    /// the rest in proportion.
    /// \param change  in parts of LayoutNode::WholeShare; nothing gets smaller than a twentieth
    bool growPanel(const QString &panelId, Qt::Orientation orientation, int change);

    /// \return the id of the new tab, which is the current one
    QString addTab(const QString &name = {});
    /// Closes a tab and its panels; in the place of the only one comes an empty one.
    bool closeTab(const QString &tabId);
    bool renameTab(const QString &tabId, const QString &name);
    /// \param index  0 ... tabs().size() - 1
    bool moveTab(const QString &tabId, int index);
    bool setCurrentTab(const QString &tabId);
    /// Closes a window and its panels.
    bool closeWindow(const QString &windowId);
    bool setWindowGeometry(const QString &windowId, const QRect &geometry);

    /// What breaks a rule of the value, as a sentence; empty: nothing.
    QString invariantError() const;

    friend bool operator==(const Layout &a, const Layout &b);

private:
    friend class LayoutReader;
    friend class LayoutWriter;

    LayoutPage *findPage(const QString &panelId);
    LayoutTab *findTab(const QString &tabId);
    LayoutWindow *findWindow(const QString &windowId);
    bool hasTarget(const LayoutTarget &target) const;
    void place(const LayoutPanel &panel, const LayoutTarget &target);
    void take(const QString &panelId);
    LayoutHome homeOf(const QString &panelId) const;
    QString newId(const QString &prefix) const;
    QString newTabName() const;

    std::vector<LayoutTab> m_tabs;
    std::vector<LayoutWindow> m_windows;
    QString m_currentTab;
    QJsonObject m_otherKeys;
};

inline bool operator!=(const Layout &a, const Layout &b)
{
    return !(a == b);
}

}  // namespace qplc

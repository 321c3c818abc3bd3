// SPDX-License-Identifier: Apache-2.0
// Edits of tabs and windows, and what is always true of a layout.
#include "Layout.h"

#include <QtCore/QSet>

#include <algorithm>
#include <numeric>

namespace qplc {

QString Layout::addTab(const QString &name)
{
    LayoutTab added;
    added.id = newId(QStringLiteral("tab"));
    added.name = name.isEmpty() ? newTabName() : name;
    m_tabs.push_back(added);
    m_currentTab = added.id;
    return added.id;
}

bool Layout::closeTab(const QString &tabId)
{
    const LayoutTab *closed = tab(tabId);
    if (!closed)
        return false;
    const auto index = std::size_t(closed - m_tabs.data());
    m_tabs.erase(m_tabs.begin() + std::ptrdiff_t(index));
    if (m_tabs.empty())
        addTab();
    if (m_currentTab == tabId)
        m_currentTab = m_tabs[std::min(index, m_tabs.size() - 1)].id;
    return true;
}

bool Layout::renameTab(const QString &tabId, const QString &name)
{
    LayoutTab *renamed = findTab(tabId);
    if (!renamed || name.isEmpty())
        return false;
    renamed->name = name;
    return true;
}

bool Layout::moveTab(const QString &tabId, int index)
{
    const LayoutTab *moved = tab(tabId);
    if (!moved || index < 0 || index >= int(m_tabs.size()))
        return false;
    const auto from = m_tabs.begin() + (moved - m_tabs.data());
    const auto to = m_tabs.begin() + index;
    if (from < to)
        std::rotate(from, from + 1, to + 1);
    else
        std::rotate(to, from, from + 1);
    return true;
}

bool Layout::setCurrentTab(const QString &tabId)
{
    if (!tab(tabId))
        return false;
    m_currentTab = tabId;
    return true;
}

bool Layout::closeWindow(const QString &windowId)
{
    const LayoutWindow *closed = window(windowId);
    if (!closed)
        return false;
    m_windows.erase(m_windows.begin() + (closed - m_windows.data()));
    return true;
}

bool Layout::setWindowGeometry(const QString &windowId, const QRect &geometry)
{
    LayoutWindow *moved = findWindow(windowId);
    if (!moved || !geometry.isValid())
        return false;
    moved->geometry = geometry;
    return true;
}

namespace {

QString nodeError(const LayoutNode &node, QSet<QString> *ids)
{
    if (node.share <= 0)
        return QStringLiteral("share %1 is not positive").arg(node.share);
    if (node.isPanel()) {
        if (node.panel.id.isEmpty() || ids->contains(node.panel.id))
            return QStringLiteral("id '%1' is empty or there twice").arg(node.panel.id);
        ids->insert(node.panel.id);
        return node.panel.type.isEmpty() ? QStringLiteral("panel '%1' has no type").arg(node.panel.id) : QString();
    }
    if (node.children.size() < 2)
        return QStringLiteral("a split has one child");
    const QVector<int> shares = node.shares();
    if (std::accumulate(shares.begin(), shares.end(), 0) != LayoutNode::WholeShare)
        return QStringLiteral("the shares of a split do not add up to the whole");
    for (const LayoutNode &child : node.children) {
        if (!child.isPanel() && child.orientation == node.orientation)
            return QStringLiteral("a split is in a split of the same orientation");
        const QString error = nodeError(child, ids);
        if (!error.isEmpty())
            return error;
    }
    return {};
}

QString pageError(const LayoutPage &page, QSet<QString> *ids)
{
    if (page.id.isEmpty() || ids->contains(page.id))
        return QStringLiteral("id '%1' is empty or there twice").arg(page.id);
    ids->insert(page.id);
    if (!page.maximized.isEmpty() && (!page.tree || !page.tree->find(page.maximized)))
        return QStringLiteral("'%1' has no panel '%2' to show alone").arg(page.id, page.maximized);
    if (!page.tree)
        return {};
    if (page.tree->share != LayoutNode::WholeShare)
        return QStringLiteral("the tree of '%1' is not whole").arg(page.id);
    return nodeError(*page.tree, ids);
}

}  // namespace

QString Layout::invariantError() const
{
    QSet<QString> ids;
    for (const LayoutTab &each : m_tabs) {
        const QString error = each.name.isEmpty() ? QStringLiteral("a tab has no name") : pageError(each, &ids);
        if (!error.isEmpty())
            return error;
    }
    for (const LayoutWindow &each : m_windows) {
        if (!each.tree || !each.geometry.isValid())
            return QStringLiteral("window '%1' has no panel or no size").arg(each.id);
        const QString error = pageError(each, &ids);
        if (!error.isEmpty())
            return error;
    }
    return tab(m_currentTab) ? QString() : QStringLiteral("there is no current tab");
}

namespace {

bool isSamePage(const LayoutPage &a, const LayoutPage &b)
{
    return a.id == b.id && a.tree == b.tree && a.maximized == b.maximized && a.otherKeys == b.otherKeys;
}

bool isSameHome(const std::optional<LayoutHome> &a, const std::optional<LayoutHome> &b)
{
    if (!a || !b)
        return a.has_value() == b.has_value();
    return a->tab == b->tab && a->beside.first == b->beside.first && a->beside.last == b->beside.last
        && a->side == b->side && a->share == b->share && a->otherKeys == b->otherKeys;
}

}  // namespace

bool operator==(const Layout &a, const Layout &b)
{
    const auto sameTab = [](const LayoutTab &x, const LayoutTab &y) { return isSamePage(x, y) && x.name == y.name; };
    const auto sameWindow = [](const LayoutWindow &x, const LayoutWindow &y) {
        return isSamePage(x, y) && x.geometry == y.geometry && x.otherGeometryKeys == y.otherGeometryKeys
            && isSameHome(x.home, y.home);
    };
    return a.m_currentTab == b.m_currentTab && a.m_otherKeys == b.m_otherKeys
        && std::equal(a.m_tabs.begin(), a.m_tabs.end(), b.m_tabs.begin(), b.m_tabs.end(), sameTab)
        && std::equal(a.m_windows.begin(), a.m_windows.end(), b.m_windows.begin(), b.m_windows.end(), sameWindow);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "Layout.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QRegularExpression>

#include <algorithm>

namespace qplc {

namespace {

template<typename Pages>
auto pageWithId(Pages &pages, const QString &id) -> decltype(pages.data())
{
    const auto found = std::find_if(pages.begin(), pages.end(), [&](const LayoutPage &page) { return page.id == id; });
    return found == pages.end() ? nullptr : &*found;
}

template<typename Pages>
auto pageWithPanel(Pages &pages, const QString &panelId) -> decltype(pages.data())
{
    const auto found = std::find_if(pages.begin(), pages.end(),
                                    [&](const LayoutPage &page) { return page.tree && page.tree->find(panelId); });
    return found == pages.end() ? nullptr : &*found;
}

/// The splits around a panel, the outermost first.
std::vector<LayoutNode *> splitsAround(const QString &panelId, LayoutNode *root)
{
    std::vector<LayoutNode *> around;
    while (!root->isPanel()) {
        around.push_back(root);
        root = &*std::find_if(root->children.begin(), root->children.end(),
                              [&](const LayoutNode &child) { return child.find(panelId) != nullptr; });
    }
    return around;
}

}  // namespace

Layout::Layout()
{
    addTab();
}

const LayoutTab &Layout::currentTab() const
{
    return *tab(m_currentTab);
}

const LayoutTab *Layout::tab(const QString &tabId) const
{
    return pageWithId(m_tabs, tabId);
}

LayoutTab *Layout::findTab(const QString &tabId)
{
    return pageWithId(m_tabs, tabId);
}

const LayoutWindow *Layout::window(const QString &windowId) const
{
    return pageWithId(m_windows, windowId);
}

LayoutWindow *Layout::findWindow(const QString &windowId)
{
    return pageWithId(m_windows, windowId);
}

const LayoutPage *Layout::pageOf(const QString &panelId) const
{
    if (const LayoutTab *page = pageWithPanel(m_tabs, panelId))
        return page;
    return pageWithPanel(m_windows, panelId);
}

LayoutPage *Layout::findPage(const QString &panelId)
{
    return const_cast<LayoutPage *>(pageOf(panelId));
}

const LayoutPanel *Layout::panel(const QString &panelId) const
{
    const LayoutPage *page = pageOf(panelId);
    return page ? &page->tree->find(panelId)->panel : nullptr;
}

std::vector<const LayoutPanel *> Layout::panels() const
{
    std::vector<const LayoutPanel *> all;
    const auto append = [&](const LayoutPage &page) {
        if (page.tree)
            page.tree->appendPanels(&all);
    };
    std::for_each(m_tabs.begin(), m_tabs.end(), append);
    std::for_each(m_windows.begin(), m_windows.end(), append);
    return all;
}

bool Layout::isFloating(const QString &panelId) const
{
    return pageWithPanel(m_windows, panelId) != nullptr;
}

QString Layout::newId(const QString &prefix) const
{
    // After the largest number in use, so that ids tell the order in which things came.
    int last = 0;
    const auto see = [&](const QString &id) {
        if (id.startsWith(prefix))
            last = std::max(last, id.midRef(prefix.size()).toInt());
    };
    for (const LayoutPage &page : m_tabs)
        see(page.id);
    for (const LayoutPage &page : m_windows)
        see(page.id);
    for (const LayoutPanel *each : panels())
        see(each->id);
    return prefix + QString::number(last + 1);
}

QString Layout::newTabName() const
{
    for (int number = 1;; ++number) {
        const QString name = QCoreApplication::translate("qplc::Layout", "Tab %1").arg(number);
        if (std::none_of(m_tabs.begin(), m_tabs.end(), [&](const LayoutTab &tab) { return tab.name == name; }))
            return name;
    }
}

bool Layout::hasTarget(const LayoutTarget &target) const
{
    switch (target.kind) {
    case LayoutTarget::Beside: {
        const LayoutPage *page = pageOf(target.span.first);
        const bool hasShare = !target.share || (*target.share > 0 && *target.share < LayoutNode::WholeShare);
        const bool hasPart = target.part > 0 && target.part < LayoutNode::WholeShare;
        return hasShare && hasPart && page && page->tree->find(target.span);
    }
    case LayoutTarget::Tab:
        return tab(target.tab) != nullptr;
    case LayoutTarget::NewTab:
        return true;
    case LayoutTarget::NewWindow:
        return target.geometry.isValid();
    }
    return false;
}

void Layout::place(const LayoutPanel &panel, const LayoutTarget &target)
{
    LayoutNode leaf;
    leaf.panel = panel;
    if (target.kind == LayoutTarget::NewWindow) {
        LayoutWindow added;
        added.id = newId(QStringLiteral("window"));
        added.tree = leaf;
        added.geometry = target.geometry;
        m_windows.push_back(added);
        return;
    }
    if (target.kind == LayoutTarget::Beside) {
        LayoutPage *page = findPage(target.span.first);
        page->tree->insert(panel, target.span, target.side, target.share, target.part);
        page->maximized.clear();
        if (LayoutWindow *shared = findWindow(page->id))
            shared->home.reset();
        else
            m_currentTab = page->id;
        return;
    }
    const QString tabId = target.kind == LayoutTarget::NewTab ? addTab(target.tab) : target.tab;
    LayoutTab *page = findTab(tabId);
    page->maximized.clear();
    m_currentTab = tabId;
    if (!page->tree) {
        page->tree = leaf;
        return;
    }
    const bool isRow = !page->tree->isPanel() && page->tree->orientation == Qt::Horizontal;
    const int columns = isRow ? int(page->tree->children.size()) : 1;
    page->tree->insert(panel, page->tree->span(), LayoutSide::Right, LayoutNode::WholeShare / (columns + 1));
}

void Layout::take(const QString &panelId)
{
    LayoutPage *page = findPage(panelId);
    if (page->maximized == panelId)
        page->maximized.clear();
    page->tree->find(panelId)->panel.id.clear();
    if (!page->tree->normalize())
        page->tree.reset();
    m_windows.erase(
        std::remove_if(m_windows.begin(), m_windows.end(), [](const LayoutWindow &each) { return !each.tree; }),
        m_windows.end());
}

QString Layout::addPanel(const QString &type, const QJsonObject &settings, const LayoutTarget &target)
{
    if (type.isEmpty() || !hasTarget(target) || isFull())
        return {};
    const LayoutPanel added{newId(QStringLiteral("panel")), type, settings, {}};
    place(added, target);
    return added.id;
}

QString Layout::duplicatePanel(const QString &panelId, LayoutSide side)
{
    const LayoutPanel *original = panel(panelId);
    if (!original || isFull())
        return {};
    LayoutPanel copy = *original;
    copy.id = newId(QStringLiteral("panel"));
    place(copy, LayoutTarget::beside(panelId, side));
    return copy.id;
}

bool Layout::closePanel(const QString &panelId)
{
    if (!panel(panelId))
        return false;
    take(panelId);
    return true;
}

bool Layout::movePanel(const QString &panelId, const LayoutTarget &target)
{
    const LayoutPanel *found = panel(panelId);
    if (!found || !hasTarget(target))
        return false;
    const LayoutPanel moved = *found;
    Layout after = *this;
    after.take(panelId);
    if (!after.hasTarget(target))  // beside itself
        return false;
    after.place(moved, target);
    *this = std::move(after);
    return true;
}

LayoutHome Layout::homeOf(const QString &panelId) const
{
    const LayoutPage *page = pageOf(panelId);
    LayoutHome home;
    home.tab = page->id;
    LayoutNode tree = *page->tree;
    const std::vector<LayoutNode *> around = splitsAround(panelId, &tree);
    if (around.empty())
        return home;
    const LayoutNode &split = *around.back();
    const auto place = std::find_if(split.children.begin(), split.children.end(),
                                    [&](const LayoutNode &child) { return child.find(panelId); });
    const bool isFirst = place == split.children.begin();
    const bool isRow = split.orientation == Qt::Horizontal;
    home.beside = (isFirst ? place + 1 : place - 1)->span();
    home.side
        = isFirst ? (isRow ? LayoutSide::Left : LayoutSide::Above) : (isRow ? LayoutSide::Right : LayoutSide::Below);
    home.share = place->share;
    return home;
}

bool Layout::floatPanel(const QString &panelId, const QRect &geometry)
{
    if (!panel(panelId) || !geometry.isValid())
        return false;
    std::optional<LayoutHome> home;
    if (!isFloating(panelId))
        home = homeOf(panelId);
    else if (const auto *before = static_cast<const LayoutWindow *>(pageOf(panelId)); before->tree->isPanel())
        home = before->home;
    movePanel(panelId, LayoutTarget::inNewWindow(geometry));
    m_windows.back().home = home;
    return true;
}

bool Layout::dockPanel(const QString &panelId)
{
    if (!isFloating(panelId))
        return false;
    const auto *from = static_cast<const LayoutWindow *>(pageOf(panelId));
    const std::optional<LayoutHome> home = from->tree->isPanel() ? from->home : std::nullopt;
    if (!home || !tab(home->tab))
        return movePanel(panelId, LayoutTarget::inTab(m_currentTab));
    const LayoutPage *neighbourPage = pageOf(home->beside.first);
    if (!neighbourPage || neighbourPage->id != home->tab || !neighbourPage->tree->find(home->beside))
        return movePanel(panelId, LayoutTarget::inTab(home->tab));
    LayoutTarget target = LayoutTarget::beside(home->beside, home->side);
    target.share = home->share;
    return movePanel(panelId, target);
}

bool Layout::setMaximized(const QString &panelId, bool isMaximized)
{
    LayoutPage *page = findPage(panelId);
    if (!page)
        return false;
    page->maximized = isMaximized ? panelId : QString();
    return true;
}

bool Layout::setPanelSettings(const QString &panelId, const QJsonObject &settings)
{
    LayoutPage *page = findPage(panelId);
    if (!page)
        return false;
    page->tree->find(panelId)->panel.settings = settings;
    return true;
}

bool Layout::setPanelTitle(const QString &panelId, const QString &title)
{
    const LayoutPanel *found = panel(panelId);
    if (!found)
        return false;
    QJsonObject settings = found->settings;
    if (title.isEmpty())
        settings.remove(QStringLiteral("title"));
    else
        settings.insert(QStringLiteral("title"), title);
    return setPanelSettings(panelId, settings);
}

bool Layout::setShares(const LayoutSpan &split, const QVector<int> &shares)
{
    LayoutPage *page = findPage(split.first);
    LayoutNode *node = page ? page->tree->find(split) : nullptr;
    if (!node || node->isPanel() || std::size_t(shares.size()) != node->children.size()
        || std::any_of(shares.begin(), shares.end(), [](int share) { return share <= 0; }))
        return false;
    node->setShares(shares);
    return true;
}

bool Layout::growPanel(const QString &panelId, Qt::Orientation orientation, int change)
{
    LayoutPage *page = findPage(panelId);
    if (!page)
        return false;
    const std::vector<LayoutNode *> around = splitsAround(panelId, &*page->tree);
    const auto split = std::find_if(around.rbegin(), around.rend(),
                                    [&](const LayoutNode *node) { return node->orientation == orientation; });
    if (split == around.rend())
        return false;
    constexpr int Least = LayoutNode::WholeShare / 20;
    const int count = int((*split)->children.size());
    QVector<int> shares = (*split)->shares();
    const int grown = int(std::find_if((*split)->children.begin(), (*split)->children.end(),
                                       [&](const LayoutNode &child) { return child.find(panelId); })
                          - (*split)->children.begin());
    const int before = shares.at(grown);
    const int after = qBound(Least, before + change, std::max(Least, LayoutNode::WholeShare - (count - 1) * Least));
    for (int i = 0; i < count; ++i) {
        const double rest = shares.at(i) * double(LayoutNode::WholeShare - after) / (LayoutNode::WholeShare - before);
        shares[i] = i == grown ? after : std::max(1, qRound(rest));
    }
    if (after == before)
        return false;
    (*split)->setShares(shares);
    return true;
}

}  // namespace qplc

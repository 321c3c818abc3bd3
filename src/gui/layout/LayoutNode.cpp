// SPDX-License-Identifier: Apache-2.0
#include "LayoutNode.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace qplc {

QString LayoutPanel::title() const
{
    const QString own = settings.value(QStringLiteral("title")).toString();
    return own.isEmpty() ? type : own;
}

QVector<int> layoutShares(const QVector<double> &weights)
{
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    // One is given to each beforehand, and the rest in proportion; what rounding left goes to the
    // largest remainders.
    QVector<int> shares(weights.size());
    QVector<double> remainders(weights.size());
    for (int i = 0; i < weights.size(); ++i) {
        const double exact = std::max(1.0, weights.at(i) / total * LayoutNode::WholeShare);
        shares[i] = static_cast<int>(std::floor(exact));
        remainders[i] = exact - shares.at(i);
    }
    QVector<int> order(weights.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return remainders.at(a) > remainders.at(b); });
    int missing = LayoutNode::WholeShare - std::accumulate(shares.begin(), shares.end(), 0);
    for (int i = 0; missing > 0; i = (i + 1) % order.size(), --missing)
        ++shares[order.at(i)];
    while (missing++ < 0)  // too many had to be lifted to 1
        --*std::max_element(shares.begin(), shares.end());
    return shares;
}

const LayoutNode *LayoutNode::find(const QString &panelId) const
{
    if (isPanel())
        return panel.id == panelId ? this : nullptr;
    for (const LayoutNode &child : children) {
        if (const LayoutNode *found = child.find(panelId))
            return found;
    }
    return nullptr;
}

LayoutNode *LayoutNode::find(const QString &panelId)
{
    return const_cast<LayoutNode *>(static_cast<const LayoutNode *>(this)->find(panelId));
}

const LayoutNode *LayoutNode::find(const LayoutSpan &span) const
{
    if (!find(span.first) || !find(span.last))
        return nullptr;
    for (const LayoutNode &child : children) {
        if (const LayoutNode *found = child.find(span))
            return found;
    }
    return this;
}

LayoutNode *LayoutNode::find(const LayoutSpan &span)
{
    return const_cast<LayoutNode *>(static_cast<const LayoutNode *>(this)->find(span));
}

LayoutSpan LayoutNode::span() const
{
    if (isPanel())
        return {panel.id, panel.id};
    return {children.front().span().first, children.back().span().last};
}

void LayoutNode::appendPanels(std::vector<const LayoutPanel *> *panels) const
{
    if (isPanel())
        panels->push_back(&panel);
    for (const LayoutNode &child : children)
        child.appendPanels(panels);
}

namespace {

/// The split that has the panel as a child; null: the panel is the root, or not there.
LayoutNode *parentOf(const QString &panelId, LayoutNode *node)
{
    for (LayoutNode &child : node->children) {
        if (child.isPanel() && child.panel.id == panelId)
            return node;
        if (LayoutNode *found = parentOf(panelId, &child))
            return found;
    }
    return nullptr;
}

/// Gives a child this share of its split, and the others the rest in their proportion.
void giveShare(LayoutNode *split, const QString &panelId, int share)
{
    QVector<double> weights;
    for (const LayoutNode &child : split->children) {
        const bool isTheOne = child.isPanel() && child.panel.id == panelId;
        const int others = LayoutNode::WholeShare - split->find(panelId)->share;
        weights.append(isTheOne ? share : child.share * double(LayoutNode::WholeShare - share) / others);
    }
    const QVector<int> shares = layoutShares(weights);
    split->setShares(shares);
}

/// Children of a split with what an edit left: those that are nothing are gone, those of the same
/// orientation are replaced by their children.
std::vector<LayoutNode> mergedChildren(LayoutNode *split, QVector<double> *weights)
{
    std::vector<LayoutNode> merged;
    for (LayoutNode &child : split->children) {
        if (!child.normalize())
            continue;
        if (child.isPanel() || child.orientation != split->orientation) {
            weights->append(child.share);
            merged.push_back(std::move(child));
            continue;
        }
        for (LayoutNode &grandchild : child.children) {
            weights->append(double(child.share) * grandchild.share / LayoutNode::WholeShare);
            merged.push_back(std::move(grandchild));
        }
    }
    return merged;
}

}  // namespace

bool LayoutNode::insert(const LayoutPanel &newPanel, const LayoutSpan &span, LayoutSide side,
                        std::optional<int> wantedShare, int part)
{
    LayoutNode *neighbour = find(span);
    if (!neighbour)
        return false;
    // A split of both; where it stands in a split of its orientation, normalize() merges them.
    LayoutNode split;
    split.share = neighbour->share;
    split.orientation = side == LayoutSide::Left || side == LayoutSide::Right ? Qt::Horizontal : Qt::Vertical;
    LayoutNode added;
    added.panel = newPanel;
    const bool isBefore = side == LayoutSide::Left || side == LayoutSide::Above;
    split.children.push_back(isBefore ? std::move(added) : std::move(*neighbour));
    split.children.push_back(isBefore ? std::move(*neighbour) : std::move(added));
    split.children.front().share = isBefore ? part : WholeShare - part;
    split.children.back().share = WholeShare - split.children.front().share;
    *neighbour = std::move(split);
    normalize();
    if (wantedShare)
        giveShare(parentOf(newPanel.id, this), newPanel.id, *wantedShare);
    return true;
}

void LayoutNode::setShares(const QVector<int> &shares)
{
    Q_ASSERT_X(std::size_t(shares.size()) == children.size(), "LayoutNode::setShares", "one share for each child");
    const QVector<int> scaled = layoutShares(QVector<double>(shares.begin(), shares.end()));
    for (int i = 0; i < scaled.size(); ++i)
        children[std::size_t(i)].share = scaled.at(i);
}

QVector<int> LayoutNode::shares() const
{
    QVector<int> all;
    for (const LayoutNode &child : children)
        all.append(child.share);
    return all;
}

bool LayoutNode::normalize()
{
    if (isPanel())
        return !panel.id.isEmpty();
    QVector<double> weights;
    std::vector<LayoutNode> merged = mergedChildren(this, &weights);
    if (merged.empty())
        return false;
    if (merged.size() == 1) {
        LayoutNode only = std::move(merged.front());
        only.share = share;
        *this = std::move(only);
        return true;
    }
    children = std::move(merged);
    const QVector<int> scaled = layoutShares(weights);
    for (int i = 0; i < scaled.size(); ++i)
        children[std::size_t(i)].share = scaled.at(i);
    return true;
}

bool operator==(const LayoutPanel &a, const LayoutPanel &b)
{
    return a.id == b.id && a.type == b.type && a.settings == b.settings && a.otherKeys == b.otherKeys;
}

bool operator==(const LayoutNode &a, const LayoutNode &b)
{
    if (a.isPanel() || b.isPanel())
        return a.isPanel() && b.isPanel() && a.share == b.share && a.panel == b.panel;
    return a.share == b.share && a.orientation == b.orientation && a.otherKeys == b.otherKeys
        && a.children == b.children;
}

bool hasSameStructure(const LayoutNode &a, const LayoutNode &b)
{
    if (a.isPanel() || b.isPanel())
        return a.isPanel() && b.isPanel() && a.panel.id == b.panel.id && a.panel.type == b.panel.type;
    return a.orientation == b.orientation
        && std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(), hasSameStructure);
}

}  // namespace qplc

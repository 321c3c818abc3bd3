// SPDX-License-Identifier: Apache-2.0
#include "PanelPlace.h"

#include <algorithm>

namespace qplc {

namespace {

struct PlacedPanel
{
    const LayoutPanel *panel;
    QSizeF size;  // [px]
};

void appendSizes(const LayoutNode &node, const QSizeF &size, std::vector<PlacedPanel> *all)
{
    if (node.isPanel()) {
        all->push_back({&node.panel, size});
        return;
    }
    for (const LayoutNode &child : node.children) {
        const double share = double(child.share) / LayoutNode::WholeShare;
        appendSizes(child,
                    node.orientation == Qt::Horizontal ? QSizeF(size.width() * share, size.height())
                                                       : QSizeF(size.width(), size.height() * share),
                    all);
    }
}

/// 1: as wanted. Less than wanted is worse than more.
double likenessOf(double size, double wanted)
{
    return size < wanted ? size / wanted : 1.0 / (1.0 + 0.25 * (size / wanted - 1.0));
}

/// How well a panel does with a size; 1: it has all that it wants.
double comfortOf(const QSizeF &size, const QSize &wanted)
{
    return std::min(1.0, size.width() / wanted.width()) * std::min(1.0, size.height() / wanted.height());
}

}  // namespace

LayoutTarget fittingPlace(const LayoutNode &tree, const QSize &page, const QSize &wanted,
                          const std::function<QSize(const LayoutPanel &)> &wantedOf)
{
    std::vector<PlacedPanel> panels;
    appendSizes(tree, QSizeF(page), &panels);
    LayoutTarget best;
    double bestScore = -1.0;
    for (const PlacedPanel &neighbour : panels) {
        for (const LayoutSide side : {LayoutSide::Right, LayoutSide::Below}) {
            const bool isRight = side == LayoutSide::Right;
            const double whole = isRight ? neighbour.size.width() : neighbour.size.height();
            const double taken = std::min(double(isRight ? wanted.width() : wanted.height()), whole / 2.0);
            const QSizeF added
                = isRight ? QSizeF(taken, neighbour.size.height()) : QSizeF(neighbour.size.width(), taken);
            const QSizeF left = isRight ? QSizeF(whole - taken, neighbour.size.height())
                                        : QSizeF(neighbour.size.width(), whole - taken);
            const double score = likenessOf(added.width(), wanted.width()) * likenessOf(added.height(), wanted.height())
                * comfortOf(left, wantedOf(*neighbour.panel));
            if (score <= bestScore * 1.001)  // of equal ones the first
                continue;
            bestScore = score;
            best = LayoutTarget::beside(neighbour.panel->id, side);
            best.part
                = std::clamp(int(LayoutNode::WholeShare * taken / std::max(whole, 1.0)), 1, LayoutNode::WholeShare / 2);
        }
    }
    return best;
}

}  // namespace qplc

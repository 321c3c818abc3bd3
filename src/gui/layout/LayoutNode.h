// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonObject>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>
#include <vector>

namespace qplc {

/// What a panel is: enough to make its widget anew.
struct LayoutPanel
{
    QString id;             // unique in a layout: "panel7"
    QString type;           // name of its factory: "Time plot"
    QJsonObject settings;   // as QPlcWidget::settings()
    QJsonObject otherKeys;  // of its file, which this program does not know

    /// What people call it: the title of its settings, else its type.
    QString title() const;
};

/// Where something comes to stand beside something else.
enum class LayoutSide { Left, Right, Above, Below };

/// The node of a tree that contains a first and a last panel and nothing around them: that panel
/// when both are the same, else the lowest split that has both. It names a split without an id, and
/// still means the same when its panels have new neighbours.
struct LayoutSpan
{
    QString first;
    QString last;
};

/// A panel, or a split of at least two nodes, none of which is a split of the same orientation.
///
/// Shares are whole numbers, so that sums are exact, and undoing gives what was.
struct LayoutNode
{
    static constexpr int WholeShare = 10000;  // what the shares of the children of a split add up to

    int share = WholeShare;                        // of the split that it is in, > 0; WholeShare for a root
    LayoutPanel panel;                             // where children is empty
    Qt::Orientation orientation = Qt::Horizontal;  // Qt::Horizontal: children stand side by side
    std::vector<LayoutNode> children;
    QJsonObject otherKeys;  // of a split

    bool isPanel() const { return children.empty(); }

    /// Null when there is none.
    const LayoutNode *find(const QString &panelId) const;
    LayoutNode *find(const QString &panelId);
    const LayoutNode *find(const LayoutSpan &span) const;
    LayoutNode *find(const LayoutSpan &span);
    LayoutSpan span() const;
    /// From left to right and from above to below.
    void appendPanels(std::vector<const LayoutPanel *> *panels) const;

    /// Puts a panel beside the node \a span. \param wantedShare of the split that then holds both;
    /// none: \a part of what the node had
    /// \return false when there is no such node; then nothing has changed
    bool insert(const LayoutPanel &newPanel, const LayoutSpan &span, LayoutSide side, std::optional<int> wantedShare,
                int part = WholeShare / 2);
    /// Makes the children have these shares, scaled to WholeShare. \pre one for each child, > 0
    void setShares(const QVector<int> &shares);
    QVector<int> shares() const;
    /// Mends what an edit or a file left: merges splits, removes those with one child or none,
    /// scales shares.
    /// \return false when nothing is left. Only a leaf without id counts as nothing.
    bool normalize();
};

/// Whole numbers > 0 in the proportion of \a weights that add up to LayoutNode::WholeShare. \pre 1
/// ... 1000 weights, finite and > 0
QVector<int> layoutShares(const QVector<double> &weights);

bool operator==(const LayoutPanel &a, const LayoutPanel &b);
bool operator==(const LayoutNode &a, const LayoutNode &b);
inline bool operator!=(const LayoutNode &a, const LayoutNode &b)
{
    return !(a == b);
}
/// Whether both have the same panels and splits in the same order, whatever their shares and
/// settings.
bool hasSameStructure(const LayoutNode &a, const LayoutNode &b);

}  // namespace qplc

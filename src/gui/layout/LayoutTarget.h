// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutNode.h"

#include <QtCore/QRect>

namespace qplc {

/// Where a panel goes.
struct LayoutTarget
{
    enum Kind { Beside, Tab, NewTab, NewWindow };

    Kind kind = Tab;
    LayoutSpan span;                        // Beside
    LayoutSide side = LayoutSide::Right;    // Beside
    std::optional<int> share;               // Beside: of the split that then holds both; none: a part of the neighbour
    int part = LayoutNode::WholeShare / 2;  // Beside, without share: of what the neighbour has
    QString tab;                            // Tab: its id. NewTab: its name; empty: the next free "Tab 2"
    QRect geometry;                         // NewWindow, in coordinates of the desktop

    static LayoutTarget beside(const QString &panelId, LayoutSide side) { return beside({panelId, panelId}, side); }
    static LayoutTarget beside(const LayoutSpan &span, LayoutSide side)
    {
        LayoutTarget target;
        target.kind = Beside;
        target.span = span;
        target.side = side;
        return target;
    }
    /// Fills an empty tab, or stands at the right of what is there.
    static LayoutTarget inTab(const QString &id)
    {
        LayoutTarget target;
        target.tab = id;
        return target;
    }
    static LayoutTarget inNewTab(const QString &name = {})
    {
        LayoutTarget target;
        target.kind = NewTab;
        target.tab = name;
        return target;
    }
    static LayoutTarget inNewWindow(const QRect &geometry)
    {
        LayoutTarget target;
        target.kind = NewWindow;
        target.geometry = geometry;
        return target;
    }
};

}  // namespace qplc

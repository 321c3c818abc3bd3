// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/Layout.h"

/// The arrangement of a page in one line: "H[panel1 V[panel2 panel3]]"; "-": empty.
inline QString described(const qplc::LayoutNode &node)
{
    if (node.isPanel())
        return node.panel.id;
    QStringList children;
    for (const qplc::LayoutNode &child : node.children)
        children.append(described(child));
    return (node.orientation == Qt::Horizontal ? QStringLiteral("H[%1]") : QStringLiteral("V[%1]"))
        .arg(children.join(QLatin1Char(' ')));
}

inline QString described(const qplc::LayoutPage &page)
{
    return page.tree ? described(*page.tree) : QStringLiteral("-");
}

/// All pages: "panel1 | - / panel2", windows behind the stroke.
inline QString described(const qplc::Layout &layout)
{
    QStringList tabs;
    for (const qplc::LayoutTab &tab : layout.tabs())
        tabs.append(described(tab));
    QStringList windows;
    for (const qplc::LayoutWindow &window : layout.windows())
        windows.append(described(window));
    return tabs.join(QStringLiteral(" | ")) + (windows.isEmpty() ? QString() : QStringLiteral(" / "))
        + windows.join(QStringLiteral(" / "));
}

/// H[panel1 V[panel2 panel3]] in one tab.
inline qplc::Layout threePanels()
{
    using namespace qplc;
    Layout layout;
    layout.addPanel(QStringLiteral("Time plot"), {}, LayoutTarget::inTab(layout.currentTab().id));
    layout.addPanel(QStringLiteral("Gauge"), {{QStringLiteral("limit"), 3}},
                    LayoutTarget::beside(QStringLiteral("panel1"), LayoutSide::Right));
    layout.addPanel(QStringLiteral("Value table"), {},
                    LayoutTarget::beside(QStringLiteral("panel2"), LayoutSide::Below));
    return layout;
}

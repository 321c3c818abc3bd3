// SPDX-License-Identifier: Apache-2.0
#include "DefaultLayout.h"

namespace qplc {

Layout defaultLayout()
{
    Layout layout;
    const QString signalsTab = layout.currentTab().id;
    layout.renameTab(signalsTab, QStringLiteral("Signals"));
    const QString plot = layout.addPanel(QStringLiteral("Time plot"), {}, LayoutTarget::inTab(signalsTab));
    LayoutTarget left = LayoutTarget::beside(plot, LayoutSide::Left);
    left.share = LayoutNode::WholeShare * 4 / 10;
    layout.addPanel(QStringLiteral("Value table"), {}, left);

    const QString realTimeTab = layout.addTab(QStringLiteral("Real time"));
    const QString nodes = layout.addPanel(QStringLiteral("Node table"), {}, LayoutTarget::inTab(realTimeTab));
    const QString jitter
        = layout.addPanel(QStringLiteral("Jitter histogram"), {}, LayoutTarget::beside(nodes, LayoutSide::Below));
    layout.addPanel(QStringLiteral("Event log"), {}, LayoutTarget::beside(jitter, LayoutSide::Right));
    layout.setCurrentTab(signalsTab);
    return layout;
}

}  // namespace qplc

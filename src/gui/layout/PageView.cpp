// SPDX-License-Identifier: Apache-2.0
#include "PageView.h"

#include "EmptyPage.h"
#include "PanelFrame.h"
#include "ShareSplitter.h"

#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace qplc {

PageView::PageView(QWidget *parent)
    : QWidget(parent)
    , m_empty(new EmptyPage(this))
{
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    setRoot(m_empty);
}

bool PageView::shows(const LayoutNode &tree, const FrameOf &frameOf) const
{
    if (!m_tree || !hasSameStructure(*m_tree, tree))
        return false;
    std::vector<const LayoutPanel *> panels;
    tree.appendPanels(&panels);
    return std::all_of(panels.begin(), panels.end(),
                       [&](const LayoutPanel *panel) { return isAncestorOf(frameOf(panel->id)); });
}

void PageView::showPage(const LayoutPage &page, const FrameOf &frameOf)
{
    if (!page.tree)
        setRoot(m_empty);
    else if (!shows(*page.tree, frameOf))
        setRoot(build(*page.tree, frameOf));
    m_tree = page.tree;
    if (m_tree)
        follow(*m_tree, m_root, page.maximized);
}

QWidget *PageView::build(const LayoutNode &node, const FrameOf &frameOf)
{
    if (node.isPanel())
        return frameOf(node.panel.id);
    auto *splitter = new ShareSplitter(node.orientation, this);
    for (const LayoutNode &child : node.children)
        splitter->addWidget(build(child, frameOf));
    connect(splitter, &ShareSplitter::sharesEdited, this, &PageView::sharesEdited);
    return splitter;
}

void PageView::setRoot(QWidget *root)
{
    // A frame that was the root may be elsewhere by now; it belongs to others.
    if (m_root && m_root != root && m_root->parentWidget() == this) {
        m_root->hide();
        layout()->removeWidget(m_root);
        if (auto *splitter = qobject_cast<ShareSplitter *>(m_root))
            m_oldSplitters.append(splitter);
    }
    m_root = root;
    layout()->addWidget(root);
    root->show();
}

void PageView::follow(const LayoutNode &node, QWidget *widget, const QString &maximized)
{
    auto *splitter = qobject_cast<ShareSplitter *>(widget);
    if (!splitter)
        return;
    for (int i = 0; i < splitter->count(); ++i) {
        const LayoutNode &child = node.children[std::size_t(i)];
        splitter->widget(i)->setVisible(maximized.isEmpty() || child.find(maximized));
        follow(child, splitter->widget(i), maximized);
    }
    if (maximized.isEmpty())
        splitter->showShares(node.span(), node.shares());
}

void PageView::dropOldSplitters()
{
    qDeleteAll(m_oldSplitters);
    m_oldSplitters.clear();
}

}  // namespace qplc

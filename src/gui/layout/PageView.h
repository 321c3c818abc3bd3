// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Layout.h"

#include <QtWidgets/QWidget>

#include <functional>

namespace qplc {

class EmptyPage;
class PanelFrame;
class ShareSplitter;

/// The tree of a tab or a floating window on the screen: splitters, made anew when the structure
/// changes, around frames that belong to others.
class PageView : public QWidget
{
    Q_OBJECT
public:
    using FrameOf = std::function<PanelFrame *(const QString &panelId)>;

    explicit PageView(QWidget *parent = nullptr);

    /// Takes the frames of the page, wherever they are. What held them before stays until
    /// dropOldSplitters().
    void showPage(const LayoutPage &page, const FrameOf &frameOf);
    /// Deletes former splitters, from which all frames must have been taken.
    void dropOldSplitters();
    /// What is shown while there are no panels.
    EmptyPage *emptyPage() const { return m_empty; }

Q_SIGNALS:
    void sharesEdited(const qplc::LayoutSpan &span, const QVector<int> &shares);

private:
    bool shows(const LayoutNode &tree, const FrameOf &frameOf) const;
    QWidget *build(const LayoutNode &node, const FrameOf &frameOf);
    void setRoot(QWidget *root);
    void follow(const LayoutNode &node, QWidget *widget, const QString &maximized);

    EmptyPage *m_empty;
    QWidget *m_root = nullptr;  // splitter, frame, or m_empty
    std::optional<LayoutNode> m_tree;
    QList<QWidget *> m_oldSplitters;
};

}  // namespace qplc

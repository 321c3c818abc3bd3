// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutEditor.h"

#include <QtWidgets/QTabBar>

namespace qplc {

/// The tabs of a layout: chosen, moved, closed, and renamed by double click or F2.
class LayoutTabBar : public QTabBar
{
    Q_OBJECT
public:
    /// \param editor  outlives the bar
    explicit LayoutTabBar(LayoutEditor *editor, QWidget *parent = nullptr);

    void showTabs(const Layout &layout);
    /// Empty where there is no tab.
    QString tabIdAt(const QPoint &position) const;
    void startRename(int index);

protected:
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    QString tabId(int index) const { return tabData(index).toString(); }
    void addTabOf(const LayoutTab &tab, int index);
    void takeMove(int from, int to);
    int indexOf(const QString &id) const;
    void makeActions();

    LayoutEditor *m_editor;
    bool m_isFollowing = false;
};

}  // namespace qplc

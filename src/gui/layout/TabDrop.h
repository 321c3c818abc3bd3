// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DropZone.h"

#include <QtCore/QPointer>

class QDragMoveEvent;
class QMimeData;

namespace qplc {

class LayoutEditor;
class LayoutTabBar;

/// Takes signals that are dragged over tabs: a tab comes to the front, so that they can be dropped
/// on one of its panels, or on the tab; the button behind the tabs is a new one.
class TabDrop : public QObject
{
    Q_OBJECT
public:
    /// \param bar, newTab, editor  outlive this object, whose parent is the bar
    TabDrop(LayoutTabBar *bar, QWidget *newTab, LayoutEditor *editor);
    ~TabDrop() override;

Q_SIGNALS:
    /// \param zone  the center of the current tab, or a new tab
    void signalsDropped(qplc::DropZone zone, const QMimeData *data);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void move(QWidget *over, QDragMoveEvent *event);
    void hideOverlay();

    LayoutTabBar *m_bar;
    QWidget *m_newTab;
    LayoutEditor *m_editor;
    QPointer<DropOverlay> m_overlay;  // its parent is what it lies over
};

}  // namespace qplc

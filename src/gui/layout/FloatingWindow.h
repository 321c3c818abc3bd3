// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutEditor.h"

#include <QtWidgets/QWidget>

namespace qplc {

class PageView;

/// A top-level window with panels. Closing it closes its panels, as one step that can be undone.
/// Keys of the main window run the same commands here.
class FloatingWindow : public QWidget
{
    Q_OBJECT
public:
    /// \param editor  outlives the window
    FloatingWindow(LayoutEditor *editor, const QString &windowId, QWidget *parent);

    const QString &windowId() const { return m_id; }
    PageView *page() const { return m_page; }
    void showWindow(const LayoutWindow &window);
    /// Shows the titles of its panels.
    void followTitles();

protected:
    bool event(QEvent *event) override;
    void moveEvent(QMoveEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void closeEvent(QCloseEvent *event) override;

private:
    void takeGeometry();

    LayoutEditor *m_editor;
    QString m_id;
    PageView *m_page;
    QRect m_geometry;  // as the layout had it last
    bool m_isFollowing = false;
};

}  // namespace qplc

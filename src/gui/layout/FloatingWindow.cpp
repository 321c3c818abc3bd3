// SPDX-License-Identifier: Apache-2.0
#include "FloatingWindow.h"

#include "PageView.h"

#include <QtGui/QCloseEvent>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

FloatingWindow::FloatingWindow(LayoutEditor *editor, const QString &windowId, QWidget *parent)
    : QWidget(parent, Qt::Window)
    , m_editor(editor)
    , m_id(windowId)
    , m_page(new PageView(this))
{
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_page);
}

void FloatingWindow::showWindow(const LayoutWindow &window)
{
    m_isFollowing = true;
    std::vector<const LayoutPanel *> panels;
    window.tree->appendPanels(&panels);
    QStringList titles;
    for (const LayoutPanel *panel : panels)
        titles.append(panel->title());
    setWindowTitle(titles.join(QStringLiteral(", ")));
    if (geometry() != window.geometry)
        setGeometry(window.geometry);
    show();
    m_isFollowing = false;
}

void FloatingWindow::takeGeometry()
{
    if (!m_isFollowing && isVisible() && !isMinimized())
        m_editor->setWindowGeometry(m_id, geometry());
}

void FloatingWindow::moveEvent(QMoveEvent *event)
{
    QWidget::moveEvent(event);
    takeGeometry();
}

void FloatingWindow::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    takeGeometry();
}

void FloatingWindow::closeEvent(QCloseEvent *event)
{
    event->ignore();  // the layout closes it
    m_editor->closeWindow(m_id);
}

}  // namespace qplc

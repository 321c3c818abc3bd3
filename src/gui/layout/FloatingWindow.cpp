// SPDX-License-Identifier: Apache-2.0
#include "FloatingWindow.h"

#include "OnScreen.h"
#include "PageView.h"

#include <QtGui/QCloseEvent>
#include <QtGui/QGuiApplication>
#include <QtGui/QScreen>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

namespace {

/// A layout may come from a larger screen.
QRect onItsScreen(const QRect &geometry)
{
    const QScreen *screen = QGuiApplication::screenAt(geometry.center());
    if (!screen)
        screen = QGuiApplication::primaryScreen();
    return onScreen(geometry, screen->availableGeometry());
}

}  // namespace

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

void FloatingWindow::followTitles()
{
    const LayoutWindow *window = m_editor->layout().window(m_id);
    if (!window)
        return;
    std::vector<const LayoutPanel *> panels;
    window->tree->appendPanels(&panels);
    QStringList titles;
    for (const LayoutPanel *panel : panels)
        titles.append(m_editor->titleOf(panel->id));
    setWindowTitle(titles.join(QStringLiteral(", ")));
}

void FloatingWindow::showWindow(const LayoutWindow &window)
{
    m_isFollowing = true;
    followTitles();
    if (m_geometry != window.geometry && geometry() != window.geometry)
        setGeometry(isVisible() ? window.geometry : onItsScreen(window.geometry));
    m_geometry = window.geometry;
    show();
    m_isFollowing = false;
}

/// The keys of an action go with the windows of its widgets; those that come to the main window
/// later are to be had, too.
bool FloatingWindow::event(QEvent *event)
{
    if (event->type() == QEvent::WindowActivate)
        addActions(parentWidget()->actions() + parentWidget()->window()->actions());
    return QWidget::event(event);
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

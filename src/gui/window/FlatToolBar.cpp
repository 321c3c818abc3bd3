// SPDX-License-Identifier: Apache-2.0
#include "FlatToolBar.h"

#include <QtGui/QPainter>
#include <QtWidgets/QAction>

namespace qplc {

FlatToolBar::FlatToolBar(const QString &title, WindowContext *context, QWidget *parent)
    : QToolBar(title, parent)
    , m_context(context)
{
    setMovable(false);
    setFloatable(false);
    toggleViewAction()->setEnabled(false);
    setContextMenuPolicy(Qt::PreventContextMenu);
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
}

void FlatToolBar::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.window);
    painter.fillRect(QRect(0, 0, width(), 1), theme.line);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme.line);
}

}  // namespace qplc

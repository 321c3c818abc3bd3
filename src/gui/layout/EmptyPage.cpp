// SPDX-License-Identifier: Apache-2.0
#include "EmptyPage.h"
#include "gui/SignalsMimeType.h"

#include "LayoutIcons.h"

#include <QtGui/QDragEnterEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

EmptyPage::EmptyPage(QWidget *parent)
    : QWidget(parent)
    , m_add(new QPushButton(layoutIcon(LayoutIcon::Add), tr("Add a panel"), this))
{
    setAcceptDrops(true);
    auto *hint = new QLabel(tr("Drop signals here or press +"), this);
    hint->setAlignment(Qt::AlignCenter);
    m_add->setAccessibleName(tr("Add a panel"));
    auto *column = new QVBoxLayout(this);
    column->addStretch();
    column->addWidget(hint);
    column->addSpacing(8);
    column->addWidget(m_add, 0, Qt::AlignHCenter);
    column->addStretch();
}

void EmptyPage::dragEnterEvent(QDragEnterEvent *event)
{
    if (!event->mimeData()->hasFormat(signalsMimeType()))
        return;
    if (!m_overlay)
        m_overlay = new DropOverlay;
    m_overlay->showOver(this, rect());
    event->acceptProposedAction();
}

void EmptyPage::dragLeaveEvent(QDragLeaveEvent *event)
{
    QWidget::dragLeaveEvent(event);
    if (m_overlay)
        m_overlay->hide();
}

void EmptyPage::dropEvent(QDropEvent *event)
{
    if (m_overlay)
        m_overlay->hide();
    event->acceptProposedAction();
    Q_EMIT signalsDropped(event->mimeData());
}

void EmptyPage::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor line = palette().color(QPalette::WindowText);
    line.setAlphaF(0.25);
    painter.setPen(QPen(line, 1, Qt::DashLine));
    painter.drawRoundedRect(QRectF(rect()).adjusted(12.5, 12.5, -12.5, -12.5), 6, 6);
}

}  // namespace qplc

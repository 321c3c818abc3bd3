// SPDX-License-Identifier: Apache-2.0
#include "NoticeLine.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

NoticeLine::NoticeLine(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_label(new QLabel(this))
    , m_row(new QHBoxLayout(this))
{
    m_label->setWordWrap(true);
    m_row->setContentsMargins(14, 4, 6, 4);
    m_row->addWidget(m_label, 1);
}

QString NoticeLine::text() const
{
    return isHidden() ? QString() : m_label->text();
}

void NoticeLine::say(const QString &text)
{
    m_label->setText(text);
    setAccessibleName(text);
    setVisible(!text.isEmpty());
}

void NoticeLine::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.surface);
    painter.fillRect(QRect(0, 0, 4, height()), theme.warning);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme.line);
}

}  // namespace qplc

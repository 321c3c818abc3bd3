// SPDX-License-Identifier: Apache-2.0
#include "EntryStrip.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

namespace qplc {

EntryStrip::EntryStrip(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_label(new QLabel)
    , m_line(new QLineEdit)
    , m_error(new QLabel)
    , m_row(new QHBoxLayout)
    , m_column(new QVBoxLayout(this))
{
    m_label->setBuddy(m_line);
    m_label->setTextFormat(Qt::PlainText);
    m_error->setWordWrap(true);
    m_error->setTextFormat(Qt::PlainText);
    m_error->hide();
    m_row->setSpacing(10);
    m_row->addWidget(m_label);
    m_row->addWidget(m_line, 1);
    m_column->setContentsMargins(14, 8, 6, 8);
    m_column->setSpacing(2);
    m_column->addLayout(m_row);
    m_column->addWidget(m_error);
    connect(m_line, &QLineEdit::returnPressed, this, &EntryStrip::accept);
    connect(m_line, &QLineEdit::textEdited, m_error, &QWidget::hide);
    hide();
}

void EntryStrip::showError(const QString &sentence)
{
    QPalette alarm = palette();
    alarm.setColor(QPalette::WindowText, m_context->theme().alarm);
    m_error->setPalette(alarm);
    m_error->setText(sentence);
    m_error->setVisible(!sentence.isEmpty());
}

QString EntryStrip::error() const
{
    return m_error->isHidden() ? QString() : m_error->text();
}

void EntryStrip::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        leave();
    else
        QWidget::keyPressEvent(event);
}

void EntryStrip::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.fillRect(rect(), m_context->theme().surface);
    painter.fillRect(QRect(0, height() - 1, width(), 1), m_context->theme().line);
}

}  // namespace qplc

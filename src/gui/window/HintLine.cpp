// SPDX-License-Identifier: Apache-2.0
#include "HintLine.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

HintLine::HintLine(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_label(new QLabel(this))
    , m_button(new BarButton(BarButton::Primary, context))
    , m_close(new BarButton(BarButton::Quiet, context))
{
    setObjectName(QStringLiteral("HintLine"));
    m_label->setWordWrap(true);
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_close->setText(tr("Close"));
    m_close->setAccessibleName(tr("Close the hint"));
    connect(m_close, &QAbstractButton::clicked, this, &QWidget::hide);
    connect(m_button, &QAbstractButton::clicked, this, [this] {
        if (m_remedy)
            m_remedy->trigger();
    });
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(14, 4, 6, 4);
    row->addWidget(m_label, 1);
    row->addWidget(m_button, 0, Qt::AlignTop);
    row->addWidget(m_close, 0, Qt::AlignTop);
    hide();
}

void HintLine::showText(const QString &text, QAction *remedy)
{
    m_remedy = remedy;
    m_button->setVisible(remedy != nullptr);
    if (remedy)
        m_button->setText(remedy->text());
    m_close->setFixedHeight((remedy ? m_button : m_close)->sizeHint().height());  // on one line with its neighbour
    m_label->setText(text);
    m_label->setMinimumHeight(m_label->fontMetrics().lineSpacing() * (int(text.count(QLatin1Char('\n'))) + 1));
    setAccessibleName(text);
    setVisible(!text.isEmpty());
}

QString HintLine::text() const
{
    return isHidden() ? QString() : m_label->text();
}

void HintLine::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.surface);
    painter.fillRect(QRect(0, 0, 4, height()), theme.warning);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme.line);
}

}  // namespace qplc

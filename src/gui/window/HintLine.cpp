// SPDX-License-Identifier: Apache-2.0
#include "HintLine.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

HintLine::HintLine(WindowContext *context, QWidget *parent)
    : NoticeLine(context, parent)
    , m_button(new BarButton(BarButton::Primary, context))
    , m_close(new BarButton(BarButton::Quiet, context))
{
    setObjectName(QStringLiteral("HintLine"));
    label()->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_close->setText(tr("Close"));
    m_close->setAccessibleName(tr("Close the hint"));
    connect(m_close, &QAbstractButton::clicked, this, &QWidget::hide);
    connect(m_button, &QAbstractButton::clicked, this, [this] {
        if (m_remedy)
            m_remedy->trigger();
    });
    row()->addWidget(m_button, 0, Qt::AlignTop);
    row()->addWidget(m_close, 0, Qt::AlignTop);
    hide();
}

void HintLine::showText(const QString &text, QAction *remedy)
{
    m_remedy = remedy;
    m_button->setVisible(remedy != nullptr);
    if (remedy)
        m_button->setText(remedy->text());
    m_close->setFixedHeight((remedy ? m_button : m_close)->sizeHint().height());  // on one line with its neighbour
    label()->setMinimumHeight(label()->fontMetrics().lineSpacing() * (int(text.count(QLatin1Char('\n'))) + 1));
    say(text);
}

}  // namespace qplc

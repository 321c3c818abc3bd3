// SPDX-License-Identifier: Apache-2.0
#include "PanelPlaceholder.h"

#include <QtGui/QPainter>

namespace qplc {

PanelPlaceholder::PanelPlaceholder(const QString &type, QWidget *parent)
    : QWidget(parent)
    , m_text(tr("Missing widget: %1\nThe panel and its settings are kept.").arg(type))
{
    setAccessibleName(m_text);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void PanelPlaceholder::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    const QColor window = palette().color(QPalette::Window);
    painter.fillRect(rect(), window.lightness() < 128 ? window.lighter(112) : window.darker(104));
    QColor text = palette().color(QPalette::WindowText);
    text.setAlphaF(0.65);
    painter.setPen(text);
    painter.drawText(rect().adjusted(12, 8, -12, -8), Qt::AlignCenter | Qt::TextWordWrap, m_text);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "ElidedLabel.h"

#include <QtGui/QPainter>

namespace qplc {

ElidedLabel::ElidedLabel(QWidget *parent)
    : QLabel(parent)
{
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setTextFormat(Qt::PlainText);
}

void ElidedLabel::showText(const QString &text)
{
    if (text == this->text())
        return;
    setText(text);
    setAccessibleName(text);
    updateToolTip();
}

void ElidedLabel::setColor(const QColor &color)
{
    QPalette colors = palette();
    if (colors.color(QPalette::WindowText) == color)
        return;
    colors.setColor(QPalette::WindowText, color);
    setPalette(colors);
}

QSize ElidedLabel::minimumSizeHint() const
{
    return {fontMetrics().averageCharWidth() * 4, fontMetrics().height()};
}

void ElidedLabel::updateToolTip()
{
    const bool isElided = fontMetrics().horizontalAdvance(text()) > contentsRect().width();
    setToolTip(isElided ? text() : QString());
}

void ElidedLabel::resizeEvent(QResizeEvent *event)
{
    QLabel::resizeEvent(event);
    updateToolTip();
}

void ElidedLabel::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setPen(palette().color(isEnabled() ? QPalette::Active : QPalette::Disabled, QPalette::WindowText));
    painter.drawText(contentsRect(), int(alignment()) | Qt::TextSingleLine,
                     fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width()));
}

}  // namespace qplc

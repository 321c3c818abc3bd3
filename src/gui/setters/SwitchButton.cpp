// SPDX-License-Identifier: Apache-2.0
#include "SwitchButton.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>

namespace qplc {

SwitchButton::SwitchButton(QWidget *parent)
    : QAbstractButton(parent)
{
    setCheckable(true);
    setFocusPolicy(Qt::StrongFocus);
}

QSize SwitchButton::sizeHint() const
{
    const int height = fontMetrics().height() + 6;
    return {2 * height + 8 + fontMetrics().horizontalAdvance(tr("off")) + 8, height + 4};
}

void SwitchButton::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QPalette::ColorGroup group = isEnabled() ? QPalette::Active : QPalette::Disabled;
    const double height = fontMetrics().height() + 4.0;
    const QRectF track(2.5, (this->height() - height) / 2.0, 1.9 * height, height);
    const QColor on = isEnabled() ? palette().color(QPalette::Highlight) : palette().color(QPalette::Mid);
    painter.setPen(QPen(hasFocus() ? palette().color(QPalette::Highlight) : palette().color(QPalette::Mid),
                        hasFocus() ? 2.0 : 1.0));
    painter.setBrush(isChecked() ? on : palette().color(QPalette::Window));
    painter.drawRoundedRect(track, height / 2.0, height / 2.0);
    const double radius = height / 2.0 - 3.0;
    const QPointF knob(isChecked() ? track.right() - height / 2.0 : track.left() + height / 2.0, track.center().y());
    painter.setPen(Qt::NoPen);
    painter.setBrush(isChecked() ? palette().color(group, QPalette::HighlightedText)
                                 : palette().color(group, QPalette::WindowText));
    painter.drawEllipse(knob, radius, radius);
    painter.setPen(palette().color(group, QPalette::WindowText));
    painter.drawText(QRectF(track.right() + 8.0, 0.0, width() - track.right() - 8.0, this->height()),
                     Qt::AlignVCenter | Qt::AlignLeft, isChecked() ? tr("on") : tr("off"));
}

void SwitchButton::keyPressEvent(QKeyEvent *event)
{
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (isEnter && !event->isAutoRepeat())
        click();
    else if (!isEnter)
        QAbstractButton::keyPressEvent(event);
}

}  // namespace qplc

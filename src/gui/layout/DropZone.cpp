// SPDX-License-Identifier: Apache-2.0
#include "DropZone.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <array>

namespace qplc {

DropZone dropZoneAt(const QRect &area, const QPoint &position, DropCenter center)
{
    const double x = (position.x() - area.left() + 0.5) / std::max(area.width(), 1);
    const double y = (position.y() - area.top() + 0.5) / std::max(area.height(), 1);
    const std::array<double, 4> distances{x, 1 - x, y, 1 - y};  // in the order of DropZone
    const auto nearest = std::min_element(distances.begin(), distances.end());
    if (center == DropCenter::IsAZone && *nearest > 0.25)
        return DropZone::Center;
    return DropZone(nearest - distances.begin());
}

QRect dropZoneRect(const QRect &area, DropZone zone)
{
    const int halfWidth = area.width() / 2;
    const int halfHeight = area.height() / 2;
    switch (zone) {
    case DropZone::Left:
        return area.adjusted(0, 0, -halfWidth, 0);
    case DropZone::Right:
        return area.adjusted(halfWidth, 0, 0, 0);
    case DropZone::Above:
        return area.adjusted(0, 0, 0, -halfHeight);
    case DropZone::Below:
        return area.adjusted(0, halfHeight, 0, 0);
    case DropZone::Center:
    case DropZone::NewTab:
    case DropZone::Area:
        break;
    }
    return area;
}

DropOverlay::DropOverlay()
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
}

void DropOverlay::showOver(QWidget *widget, const QRect &rect, const QString &text)
{
    m_text = text;
    update();
    if (parentWidget() != widget)
        setParent(widget);
    setGeometry(rect);
    raise();
    show();
}

void DropOverlay::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor fill = palette().color(QPalette::Highlight);
    painter.setPen(QPen(fill, 2));
    fill.setAlphaF(0.25);
    painter.setBrush(fill);
    painter.drawRoundedRect(QRectF(rect()).adjusted(2, 2, -2, -2), 3, 3);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, m_text);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "GaugePaint.h"

#include "gui/panel/FigureFont.h"

#include <algorithm>

namespace qplc {

QColor levelColor(AlarmState::Level level, const Theme &theme)
{
    return level == AlarmState::Alarm ? theme.alarm : level == AlarmState::Warning ? theme.warning : theme.accent;
}

QColor pointerColor(const GaugePicture &picture, const Theme &theme)
{
    return picture.isTrusted ? levelColor(picture.level, theme) : theme.stale;
}

QColor textColor(const GaugePicture &picture, const Theme &theme)
{
    if (!picture.isTrusted)
        return theme.stale;
    return picture.level == AlarmState::Normal ? theme.text : levelColor(picture.level, theme);
}

QFont fittingFont(const QFont &font, const QString &text, const QSizeF &size, double largest)
{
    constexpr int measured = 100;  // [px]
    QFont fitting = font;
    fitting.setPixelSize(measured);
    const QFontMetricsF metrics(fitting);
    const double width = std::max(metrics.horizontalAdvance(text), 1.0);
    const double scale = std::min(size.width() / width, size.height() / metrics.height());
    fitting.setPixelSize(std::max(6, int(std::min(measured * scale, largest))));
    return fitting;
}

void paintValue(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QString &text,
                const QColor &color)
{
    const QString widest = picture.widest.size() > text.size() ? picture.widest : text;
    const QString unit = picture.unit.isEmpty() ? QString() : QStringLiteral(" ") + picture.unit;
    // The unit is half as large as the figures.
    const double unitShare = 0.5 * double(unit.size()) / std::max(1.0, double(widest.size()));
    const QSizeF room(place.width() / (1.0 + unitShare), place.height());
    const QFont font = fittingFont(figureFont(painter->font()), widest, room);
    QFont unitFont = font;
    unitFont.setPixelSize(std::max(9, font.pixelSize() / 2));
    const QFontMetricsF metrics(font);
    const double width = metrics.horizontalAdvance(widest);
    const double left = place.center().x() - (width + QFontMetricsF(unitFont).horizontalAdvance(unit)) / 2.0;
    const double baseline = place.center().y() + metrics.capHeight() / 2.0;
    painter->save();
    painter->setFont(font);
    painter->setPen(color);
    painter->drawText(QPointF(left + width - metrics.horizontalAdvance(text), baseline), text);
    painter->setFont(unitFont);
    painter->setPen(picture.isTrusted ? QColor(painter->pen().color()) : color);
    painter->drawText(QPointF(left + width, baseline), unit);
    painter->restore();
}

namespace {

void paintMessage(QPainter *painter, const QRectF &place, const GaugePicture &picture, const Theme &theme)
{
    painter->setPen(theme.mutedText);
    painter->drawText(place.adjusted(8, 4, -8, -4), Qt::AlignCenter | Qt::TextWordWrap, picture.message);
}

/// Name at the left, what is not normal at the right; a narrow gauge says the more important one.
void paintFooter(QPainter *painter, const QRectF &place, const GaugePicture &picture, const Theme &theme)
{
    const QFontMetricsF metrics(painter->font());
    const double statusWidth = picture.status.isEmpty() ? 0.0 : metrics.horizontalAdvance(picture.status) + 6.0;
    const double nameWidth = place.width() - statusWidth;
    const bool hasBoth = nameWidth > metrics.averageCharWidth() * 8.0;
    if (picture.status.isEmpty() || hasBoth) {
        painter->setPen(theme.mutedText);
        const QString name = metrics.elidedText(picture.name, Qt::ElideMiddle, nameWidth);
        const int side = picture.status.isEmpty() ? Qt::AlignHCenter : Qt::AlignLeft;
        painter->drawText(QRectF(place.left(), place.top(), nameWidth, place.height()), side | Qt::AlignVCenter, name);
    }
    painter->setPen(textColor(picture, theme));
    painter->drawText(place, (hasBoth ? Qt::AlignRight : Qt::AlignHCenter) | Qt::AlignVCenter,
                      metrics.elidedText(picture.status, Qt::ElideRight, place.width()));
}

}  // namespace

void paintGauge(QPainter *painter, const QRectF &place, const GaugePicture &picture, const Theme &theme)
{
    painter->setRenderHint(QPainter::Antialiasing);
    if (!picture.message.isEmpty()) {
        paintMessage(painter, place, picture, theme);
        return;
    }
    const double margin = 6.0;
    const double line = QFontMetricsF(painter->font()).height();
    const QRectF inside = place.adjusted(margin, margin, -margin, -margin);
    paintFooter(painter, QRectF(inside.left(), inside.bottom() - line, inside.width(), line), picture, theme);
    const QRectF body = inside.adjusted(0, 0, 0, -line - 2.0);
    switch (picture.style) {
    case GaugeStyle::Dial:
        paintDial(painter, body, picture, theme);
        break;
    case GaugeStyle::Bar:
        paintBar(painter, body, picture, theme);
        break;
    case GaugeStyle::Number:
        paintNumbers(painter, body, picture, theme);
        break;
    case GaugeStyle::Led:
        paintLed(painter, body, picture, theme);
        break;
    }
}

}  // namespace qplc

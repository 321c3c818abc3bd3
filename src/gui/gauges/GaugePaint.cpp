// SPDX-License-Identifier: Apache-2.0
#include "GaugePaint.h"

#include "gui/panel/FigureFont.h"

#include <algorithm>

namespace qplc {

QColor levelColor(AlarmState::Level level, const QPlcTheme &theme)
{
    return level == AlarmState::Alarm ? theme.alarm : level == AlarmState::Warning ? theme.warning : theme.accent;
}

QColor trackColor(const QPlcTheme &theme)
{
    constexpr int mostContrast = 60;
    const int contrast = std::abs(theme.surface.lightness() - theme.line.lightness());
    const double share = contrast > mostContrast ? double(mostContrast) / contrast : 1.0;
    const auto mix = [share](int behind, int line) { return int(behind + share * (line - behind)); };
    return {mix(theme.surface.red(), theme.line.red()), mix(theme.surface.green(), theme.line.green()),
            mix(theme.surface.blue(), theme.line.blue())};
}

QColor pointerColor(const GaugePicture &picture, const QPlcTheme &theme)
{
    return picture.isTrusted ? levelColor(picture.level, theme) : theme.stale;
}

QColor textColor(const GaugePicture &picture, const QPlcTheme &theme)
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

namespace {

/// Of two texts the wider one, as figures.
QString wider(const QString &first, const QString &second, const QFont &font)
{
    const QFontMetricsF metrics(figureFont(font));
    return metrics.horizontalAdvance(second) > metrics.horizontalAdvance(first) + 0.5 ? second : first;
}

}  // namespace

double paintValue(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QString &text,
                  const QColor &color, Qt::AlignmentFlag side)
{
    const QString widest = wider(picture.widest, text, painter->font());
    const QString sizing = wider(widest, picture.sizing, painter->font());
    const QString unit = picture.prefix.unit().isEmpty() ? QString() : QStringLiteral(" ") + picture.prefix.unit();
    // The unit is half as large as the figures. A sign hangs at their left: what has none stands in
    // the middle.
    const bool hasSign = widest.startsWith(minusSign);
    const QString digits = hasSign ? widest.mid(1) : widest;
    const int unitSize = std::max(unit.size(), picture.widestUnit.isEmpty() ? 0 : picture.widestUnit.size() + 1);
    const double unitShare = 0.5 * double(unitSize) / std::max(1.0, double(sizing.size()));
    const QSizeF room(place.width() / (1.0 + unitShare), place.height());
    const QFont font = fittingFont(figureFont(painter->font()), sizing, room);
    QFont unitFont = font;
    unitFont.setPixelSize(std::max(9, font.pixelSize() / 2));
    const QFontMetricsF metrics(font);
    const double width = metrics.horizontalAdvance(digits);
    const double whole = width + QFontMetricsF(unitFont).horizontalAdvance(unit);
    const double left = side == Qt::AlignRight ? place.right() - whole : place.center().x() - whole / 2.0;
    const double baseline = place.center().y() + metrics.capHeight() / 2.0;
    painter->save();
    painter->setFont(font);
    painter->setPen(color);
    const double missing = width - metrics.horizontalAdvance(text);
    painter->drawText(QPointF(left + (text == noValueText() ? missing / 2.0 : missing), baseline), text);
    painter->setFont(unitFont);
    painter->drawText(QPointF(left + width, baseline), unit);
    painter->restore();
    return hasSign ? left - metrics.horizontalAdvance(minusSign) : left;
}

void paintStatus(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme, int side)
{
    painter->setPen(textColor(picture, theme));
    const QString status = QFontMetricsF(painter->font()).elidedText(picture.status, Qt::ElideRight, place.width());
    painter->drawText(place, side | Qt::AlignVCenter, status);
}

namespace {

/// The line below is there also while it is empty, so that nothing jumps, but where space is rare.
bool hasLine(const QRectF &place, const GaugePicture &picture)
{
    constexpr double roomy = 100.0;  // [px]
    if (picture.showsName)
        return true;
    return !isLyingBar(place, picture) && (!picture.status.isEmpty() || place.height() > roomy);
}

void paintMessage(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    painter->setPen(theme.mutedText);
    painter->drawText(place.adjusted(8, 4, -8, -4), Qt::AlignCenter | Qt::TextWordWrap, picture.message);
}

void paintName(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme, int side)
{
    painter->setPen(theme.mutedText);
    const QString name = QFontMetricsF(painter->font()).elidedText(picture.name, Qt::ElideMiddle, place.width());
    painter->drawText(place, side | Qt::AlignVCenter, name);
}

/// One line below: name at the left, what is not normal at the right. \return what is left for the
/// gauge
QRectF paintLine(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    const QFontMetricsF metrics(painter->font());
    const QRectF line(place.left(), place.bottom() - metrics.height(), place.width(), metrics.height());
    if (!picture.showsName) {
        paintStatus(painter, line, picture, theme, Qt::AlignHCenter);
        return place.adjusted(0.0, 0.0, 0.0, -metrics.height() - 2.0);
    }
    const double statusWidth = picture.status.isEmpty() ? 0.0 : metrics.horizontalAdvance(picture.status) + 6.0;
    const double nameWidth = place.width() - statusWidth;
    if (picture.status.isEmpty())
        paintName(painter, line, picture, theme, Qt::AlignHCenter);
    else if (nameWidth > metrics.averageCharWidth() * 6.0)
        paintName(painter, QRectF(line.topLeft(), QSizeF(nameWidth, line.height())), picture, theme, Qt::AlignLeft);
    paintStatus(painter, line, picture, theme, Qt::AlignRight);
    return place.adjusted(0.0, 0.0, 0.0, -metrics.height() - 2.0);
}

/// Where one line is too short for both: the name above, and below what is not normal. The space
/// for it is always there, so that nothing jumps.
QRectF paintTwoLines(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    const double height = QFontMetricsF(painter->font()).height();
    paintName(painter, QRectF(place.left(), place.top() - 2.0, place.width(), height), picture, theme,
              Qt::AlignHCenter);
    paintStatus(painter, QRectF(place.left(), place.bottom() - height + 2.0, place.width(), height), picture, theme,
                Qt::AlignHCenter);
    return place.adjusted(0.0, height, 0.0, -height + 2.0);
}

}  // namespace

void paintGauge(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    painter->setRenderHint(QPainter::Antialiasing);
    if (!picture.message.isEmpty()) {
        paintMessage(painter, place, picture, theme);
        return;
    }
    const double margin = 6.0;
    const QRectF inside = place.adjusted(margin, margin, -margin, -margin);
    const QFontMetricsF metrics(painter->font());
    const bool hasTwoLines = picture.showsName && inside.width() < 26.0 * metrics.averageCharWidth()
        && inside.height() > 6.0 * metrics.height();
    QRectF body = inside;
    GaugePicture rest = picture;
    if (hasTwoLines || hasLine(inside, picture)) {
        body
            = hasTwoLines ? paintTwoLines(painter, inside, picture, theme) : paintLine(painter, inside, picture, theme);
        rest.status.clear();
    }
    switch (picture.style) {
    case GaugeStyle::Dial:
        paintDial(painter, body, rest, theme);
        break;
    case GaugeStyle::Bar:
        paintBar(painter, body, rest, theme);
        break;
    case GaugeStyle::Number:
        paintNumbers(painter, body, rest, theme);
        break;
    case GaugeStyle::Led:
        paintLed(painter, body, rest, theme);
        break;
    }
}

}  // namespace qplc

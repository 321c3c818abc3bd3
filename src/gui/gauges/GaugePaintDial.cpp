// SPDX-License-Identifier: Apache-2.0
#include "GaugePaint.h"

#include <QtCore/QtMath>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double firstAngle = 225.0;  // [deg], counterclockwise from the right
constexpr double sweep = 270.0;

double angleOf(const GaugePicture &picture, double value)
{
    return firstAngle - sweep * picture.scale.share(value);
}

/// The geometry of one dial.
struct Dial
{
    QPointF center;
    double radius;  // of the middle of the track
    double track;   // its width

    QPointF at(double angle, double distance) const
    {
        const double rad = qDegreesToRadians(angle);
        return center + QPointF(std::cos(rad), -std::sin(rad)) * distance;
    }

    void arc(QPainter *painter, double from, double to, const QColor &color, double distance, double width,
             Qt::PenCapStyle cap = Qt::FlatCap) const
    {
        painter->setPen(QPen(color, width, Qt::SolidLine, cap));
        const QRectF circle(center.x() - distance, center.y() - distance, 2.0 * distance, 2.0 * distance);
        painter->drawArc(circle, qRound(from * 16.0), qRound((to - from) * 16.0));
    }
};

Dial dialIn(const QRectF &place)
{
    // The gap at the bottom leaves 1 + cos 45 deg of the height of the circle.
    const double outer = std::min(place.width() / 2.0, place.height() / 1.75);
    const double track = std::clamp(outer * 0.13, 5.0, 18.0);
    return {{place.center().x(), place.top() + (place.height() - 1.75 * outer) / 2.0 + outer}, outer - track, track};
}

void paintTicks(QPainter *painter, const Dial &dial, const GaugePicture &picture, const QPlcTheme &theme)
{
    const bool hasLabels = dial.radius > 62.0;
    const QVector<double> ticks = picture.scale.ticks(hasLabels ? 7 : 5);
    const double outside = dial.radius - dial.track / 2.0 - 2.0;
    const double length = std::clamp(dial.radius * 0.06, 2.5, 7.0);
    QFont font = painter->font();
    font.setPixelSize(std::clamp(int(dial.radius * 0.14), 9, 14));
    painter->setFont(font);
    const QFontMetricsF metrics(font);
    for (const double tick : ticks) {
        const double angle = angleOf(picture, tick);
        painter->setPen(QPen(theme.mutedText, 1.2));
        painter->drawLine(dial.at(angle, outside), dial.at(angle, outside - length));
        if (!hasLabels)
            continue;
        const QString text = picture.tickText(tick);
        const double width = metrics.horizontalAdvance(text);
        const QPointF center = dial.at(angle, outside - length - 2.0 - std::max(width * 0.5, metrics.height() * 0.5));
        painter->drawText(
            QRectF(center.x() - width, center.y() - metrics.height(), 2.0 * width, 2.0 * metrics.height()),
            Qt::AlignCenter, text);
    }
}

void paintMarkers(QPainter *painter, const Dial &dial, const GaugePicture &picture, const QPlcTheme &theme)
{
    const GaugePicture::Value &value = picture.values.first();
    for (const std::optional<double> &extreme : {value.minimum, value.maximum}) {
        if (!extreme)
            continue;
        const double angle = angleOf(picture, *extreme);
        const double inside = dial.radius - dial.track * 0.5;
        painter->setPen(QPen(theme.text, 2.0));
        painter->drawLine(dial.at(angle, inside), dial.at(angle, inside + dial.track));
    }
}

/// From 0, or from the end that is nearest to it.
void paintPointer(QPainter *painter, const Dial &dial, const GaugePicture &picture, const QPlcTheme &theme)
{
    const double number = picture.values.first().number;
    if (std::isnan(number))
        return;
    const QColor color = pointerColor(picture, theme);
    const double angle = angleOf(picture, number);
    QColor filled = color;
    filled.setAlphaF(picture.isTrusted ? 0.85 : 0.5);
    dial.arc(painter, angleOf(picture, 0.0), angle, filled, dial.radius, dial.track);
    // The head of the pointer stands out of the track, so that 0 is seen too.
    const double half = dial.track / 2.0 + 3.0;
    painter->setPen(QPen(theme.surface, std::max(5.0, dial.track * 0.42), Qt::SolidLine, Qt::RoundCap));
    painter->drawLine(dial.at(angle, dial.radius - half), dial.at(angle, dial.radius + half - 2.0));
    painter->setPen(QPen(color, std::max(3.0, dial.track * 0.24), Qt::SolidLine, Qt::RoundCap));
    painter->drawLine(dial.at(angle, dial.radius - half), dial.at(angle, dial.radius + half - 2.0));
}

}  // namespace

void paintDial(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    const Dial dial = dialIn(place);
    painter->save();
    dial.arc(painter, firstAngle, firstAngle - sweep, trackColor(theme), dial.radius, dial.track);
    const double rim = dial.radius + dial.track / 2.0 + 2.0;
    for (const GaugePicture::Band &band : picture.bands)
        dial.arc(painter, angleOf(picture, band.begin), angleOf(picture, band.end), levelColor(band.level, theme), rim,
                 3.0);
    paintTicks(painter, dial, picture, theme);
    paintMarkers(painter, dial, picture, theme);
    paintPointer(painter, dial, picture, theme);
    painter->restore();
    const double signless = picture.widest.startsWith(minusSign) ? 1.0 : 0.87;  // a sign hangs at the left
    const double width = dial.radius * signless * (dial.radius > 62.0 ? 0.95 : 1.45);
    GaugePicture figures = picture;
    figures.prefix = SiPrefix();
    figures.widestUnit.clear();
    if (figures.sizing.isEmpty())
        figures.sizing = QStringLiteral("000.00");  // dials side by side have figures of one size
    const QRectF middle(dial.center.x() - width / 2.0, dial.center.y() - dial.radius * 0.2, width, dial.radius * 0.6);
    paintValue(painter, middle, figures, picture.values.first().text, textColor(picture, theme));
    painter->save();
    QFont font = painter->font();
    font.setPixelSize(std::clamp(int(dial.radius * 0.2), 10, 20));
    painter->setFont(font);
    painter->setPen(picture.isTrusted ? theme.mutedText : theme.stale);
    painter->drawText(
        QRectF(dial.center.x() - width, dial.center.y() + dial.radius * 0.36, 2.0 * width, dial.radius * 0.4),
        Qt::AlignHCenter | Qt::AlignVCenter, picture.prefix.unit());
    painter->restore();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "GaugePaint.h"

#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

/// A bar that lies or stands: the same drawing along its length.
struct Bar
{
    QRectF track;
    bool isLying;

    double at(double share) const
    {
        return isLying ? track.left() + share * track.width() : track.bottom() - share * track.height();
    }
    /// What is between two places along the bar, over its whole thickness.
    QRectF between(double from, double to) const
    {
        const double low = std::min(from, to);
        const double size = std::abs(to - from);
        return isLying ? QRectF(low, track.top(), size, track.height())
                       : QRectF(track.left(), low, track.width(), size);
    }
    /// Beside the bands, if there are any.
    double tickOffset(const GaugePicture &picture) const { return picture.bands.isEmpty() ? 2.0 : 6.0; }
    /// A strip along the side where the numbers are.
    QRectF strip(double from, double to, double offset, double width) const
    {
        const QRectF all = between(from, to);
        return isLying ? QRectF(all.left(), track.bottom() + offset, all.width(), width)
                       : QRectF(track.right() + offset, all.top(), width, all.height());
    }
};

void paintTrack(QPainter *painter, const Bar &bar, const GaugePicture &picture, const QPlcTheme &theme)
{
    painter->setPen(Qt::NoPen);
    QPainterPath round;
    round.addRoundedRect(bar.track, 3.0, 3.0);
    painter->fillPath(round, trackColor(theme));
    painter->save();
    painter->setClipPath(round);
    const GaugePicture::Value &value = picture.values.first();
    const double place = bar.at(picture.scale.share(value.number));
    QColor filled = pointerColor(picture, theme);
    const bool hasValue = !std::isnan(value.number);
    if (hasValue)
        painter->fillRect(bar.between(bar.at(picture.scale.share(0.0)), place), filled);
    for (const std::optional<double> &extreme : {value.minimum, value.maximum}) {
        if (extreme)
            painter->fillRect(
                bar.between(bar.at(picture.scale.share(*extreme)) - 1.0, bar.at(picture.scale.share(*extreme)) + 1.0),
                theme.text);
    }
    painter->restore();
    // The end of the bar is seen also where it is at 0.
    if (!hasValue)
        return;
    const QRectF head = bar.between(place - 1.5, place + 1.5);
    painter->fillRect(bar.isLying ? head.adjusted(0, -2, 0, 2) : head.adjusted(-2, 0, 2, 0), filled);
}

void paintScale(QPainter *painter, const Bar &bar, const GaugePicture &picture, const QPlcTheme &theme)
{
    for (const GaugePicture::Band &band : picture.bands)
        painter->fillRect(
            bar.strip(bar.at(picture.scale.share(band.begin)), bar.at(picture.scale.share(band.end)), 2.5, 3.0),
            levelColor(band.level, theme));
    const QFontMetricsF metrics(painter->font());
    const double length = bar.isLying ? bar.track.width() : bar.track.height();
    const double room = bar.isLying ? metrics.horizontalAdvance(QLatin1Char('0')) * 7.0 : metrics.height() * 2.0;
    const int most = int(length / room);
    const QVector<double> ends{picture.scale.minimum, picture.scale.maximum};
    const QVector<double> ticks = most < 4 ? ends : picture.scale.ticks(std::min(most, 11));
    for (const double tick : ticks) {
        const double place = std::round(bar.at(picture.scale.share(tick))) + 0.5;
        painter->setPen(QPen(theme.mutedText, 1.0));
        const double offset = bar.tickOffset(picture);
        const QRectF line = bar.strip(place, place, offset, 3.0);
        painter->drawLine(line.topLeft(), bar.isLying ? line.bottomLeft() : line.topRight());
        const QString text = picture.tickText(tick);
        const double width = metrics.horizontalAdvance(text);
        if (bar.isLying) {
            const double left = std::clamp(place - width / 2.0, bar.track.left(), bar.track.right() - width);
            painter->drawText(QPointF(left, bar.track.bottom() + offset + 5.0 + metrics.capHeight()), text);
        } else {
            const double baseline = std::clamp(place + metrics.capHeight() / 2.0, bar.track.top() + metrics.capHeight(),
                                               bar.track.bottom());
            painter->drawText(QPointF(bar.track.right() + offset + 6.0, baseline), text);
        }
    }
}

/// \param scale  height of ticks and their numbers
Bar lyingBar(const QRectF &place, double scale)
{
    const double thickness = std::clamp((place.height() - scale) * 0.25, 6.0, 36.0);
    return {QRectF(place.left() + 2.0, place.bottom() - scale - thickness, place.width() - 4.0, thickness), true};
}

Bar standingBar(const QRectF &place, double scale, double value)
{
    const double thickness = std::clamp((place.width() - scale) * 0.5, 10.0, 36.0);
    const double left = place.center().x() - (thickness + scale) / 2.0;
    return {QRectF(left, place.top() + value + 4.0, thickness, place.height() - value - 8.0), false};
}

/// The number is what is read first: as large as there is space, at the right end of a bar that
/// lies.
void paintBarValue(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme,
                   bool isLying)
{
    constexpr double tallest = 40.0;  // [px]
    const double height = std::min(place.height(), tallest);
    const QRectF row(place.left(), place.bottom() - height, place.width(), height);
    const double beyond = 0.2 * height;  // figures have nothing above and below them
    painter->save();
    QFont bold = painter->font();
    bold.setWeight(QFont::DemiBold);
    painter->setFont(bold);
    const double left
        = paintValue(painter, row.adjusted(0.0, -beyond, 0.0, beyond), picture, picture.values.first().text,
                     textColor(picture, theme), isLying ? Qt::AlignRight : Qt::AlignHCenter);
    painter->restore();
    if (isLying && !picture.status.isEmpty())
        paintStatus(painter, QRectF(row.left(), row.top(), left - row.left() - 6.0, row.height()), picture, theme,
                    Qt::AlignLeft);
}

}  // namespace

bool isLyingBar(const QRectF &place, const GaugePicture &picture)
{
    return picture.style == GaugeStyle::Bar && place.width() > place.height();
}

void paintBar(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    painter->save();
    QFont font = painter->font();
    font.setPixelSize(10);
    const QFontMetricsF metrics(font);
    const bool isLying = isLyingBar(place, picture);
    const double labels = metrics.horizontalAdvance(QStringLiteral("−0000")) + 14.0;
    const double value = std::clamp(place.height() * 0.18, 16.0, 34.0);
    const double scale = (picture.bands.isEmpty() ? 7.0 : 11.0) + metrics.capHeight();
    const Bar bar = isLying ? lyingBar(place, scale) : standingBar(place, labels, value);
    const QRectF above(place.left(), place.top(), place.width(), isLying ? bar.track.top() - place.top() - 4.0 : value);
    paintBarValue(painter, above, picture, theme, isLying);
    painter->setFont(font);
    paintTrack(painter, bar, picture, theme);
    paintScale(painter, bar, picture, theme);
    painter->restore();
}

}  // namespace qplc

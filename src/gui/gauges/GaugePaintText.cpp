// SPDX-License-Identifier: Apache-2.0
#include "GaugePaint.h"

#include <QtGui/QRadialGradient>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

QString rangeText(const GaugePicture &picture, const GaugePicture::Value &value)
{
    if (!value.minimum || !value.maximum)
        return {};
    return QStringLiteral("%1 … %2").arg(picture.text(*value.minimum), picture.text(*value.maximum));
}

}  // namespace

void paintNumbers(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    const QFontMetricsF metrics(painter->font());
    const int count = picture.values.size();
    const double height = place.height() / double(count);
    const double index = count > 1 ? metrics.horizontalAdvance(QStringLiteral("[0] ")) : 0.0;
    for (int i = 0; i < count; ++i) {
        const GaugePicture::Value &value = picture.values.at(i);
        const QString range = rangeText(picture, value);
        const bool hasRange = !range.isEmpty() && height > 2.5 * metrics.height();
        const QRectF row(place.left(), place.top() + i * height, place.width(), height);
        const double below = hasRange ? metrics.height() : 0.0;
        paintValue(painter, row.adjusted(index, 0, 0, -below), picture, value.text, textColor(picture, theme));
        painter->setPen(theme.mutedText);
        if (count > 1)
            painter->drawText(row, Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("[%1]").arg(i));
        if (hasRange)
            painter->drawText(row, Qt::AlignHCenter | Qt::AlignBottom, range);
    }
}

void paintLed(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme)
{
    const GaugePicture::Value &value = picture.values.first();
    const bool isOn = value.number != 0.0;
    const bool isNormal = picture.level == AlarmState::Normal;
    const bool isLit = !std::isnan(value.number) && (isOn || !picture.isBoolean);
    const QColor lit = !picture.isTrusted ? theme.stale : isNormal ? theme.good : levelColor(picture.level, theme);
    const bool isWide = place.width() > 1.6 * place.height();
    const double size
        = std::min({isWide ? place.width() * 0.35 : place.width(), place.height() * (isWide ? 0.7 : 0.55), 96.0});
    const QPointF center(isWide ? place.left() + place.width() * 0.28 : place.center().x(),
                         isWide ? place.center().y() : place.top() + place.height() * 0.34);
    const double radius = size / 2.0;
    if (isLit) {
        QRadialGradient shine(center - QPointF(radius, radius) * 0.3, radius * 1.3);
        shine.setColorAt(0.0, lit.lighter(theme.isDark ? 118 : 135));
        shine.setColorAt(1.0, lit);
        painter->setBrush(shine);
        painter->setPen(QPen(lit.darker(115), 1.5));
    } else {
        painter->setBrush(Qt::NoBrush);
        painter->setPen(QPen(picture.isTrusted ? theme.mutedText : theme.stale, 2.0));
    }
    painter->drawEllipse(center, radius - 2.0, radius - 2.0);
    painter->setBrush(Qt::NoBrush);
    const QRectF text = isWide
        ? QRectF(place.left() + place.width() * 0.5, place.top(), place.width() * 0.48, place.height())
        : QRectF(place.left(), place.top() + place.height() * 0.7, place.width(), place.height() * 0.26);
    paintValue(painter,
               text.adjusted(0, text.height() * (isWide ? 0.3 : 0.0), 0, -text.height() * (isWide ? 0.3 : 0.0)),
               picture, value.text, textColor(picture, theme));
}

}  // namespace qplc

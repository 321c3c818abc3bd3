// SPDX-License-Identifier: Apache-2.0
#include "KiteOverlay.h"

#include "KiteText.h"

#include <QtCore/QDateTime>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr double barWidth = 84.0;  // [px]
constexpr double barHeight = 5.0;  // [px]

QLinearGradient gradient(const ColorScale &scale, const QPointF &from, const QPointF &to)
{
    QLinearGradient gradient(from, to);
    for (int i = 0; i <= 8; ++i)
        gradient.setColorAt(i / 8.0, scale.color(scale.minimum + (scale.maximum - scale.minimum) * i / 8.0));
    return gradient;
}

}  // namespace

void drawColorBar(QPainter *painter, const QPointF &topLeft, const ColorScale &scale, const QString &title,
                  const QPlcTheme &theme)
{
    const QFontMetricsF metrics(painter->font());
    const double line = metrics.height();
    painter->setPen(theme.mutedText);
    painter->drawText(topLeft + QPointF(0, metrics.ascent()), title);
    const QString minimum = QString::number(scale.minimum, 'g', 6);
    const QString maximum = QString::number(scale.maximum, 'g', 6);
    const double texts = metrics.horizontalAdvance(minimum) + metrics.horizontalAdvance(maximum) + line;
    const QRectF bar(topLeft.x(), topLeft.y() + line + 1.0, std::max(barWidth, texts), barHeight);
    painter->fillRect(bar, gradient(scale, bar.topLeft(), bar.topRight()));
    const QRectF ends(bar.left(), bar.bottom() + 1.0, bar.width(), line);
    painter->drawText(ends, Qt::AlignLeft | Qt::AlignTop, minimum);
    painter->drawText(ends, Qt::AlignRight | Qt::AlignTop, maximum);
}

void drawReadout(QPainter *painter, const QRectF &area, const KiteState &state, const QPlcTheme &theme)
{
    if (!state.position)
        return;
    const SkyPosition sky = skyPosition(*state.position);
    const double azimuth = std::round(wrappedAngle(double(sky.azimuth - state.downwind()))) + 0.0;  // no -0
    const QString lines[] = {
        KiteText::tr("azimuth %1 deg").arg(azimuth, 0, 'f', 0),
        KiteText::tr("elevation %1 deg").arg(double(sky.elevation), 0, 'f', 0),
        KiteText::tr("distance %1 m").arg(double(sky.distance), 0, 'f', 0),
    };
    painter->setPen(state.isStale && !state.pastTime ? theme.stale : theme.mutedText);
    const double height = QFontMetricsF(painter->font()).height();
    QRectF line(area.left(), area.top(), area.width(), height);
    for (const QString &text : lines) {
        painter->drawText(line, Qt::AlignRight | Qt::AlignVCenter, text);
        line.translate(0, height);
    }
}

QString stateText(const KiteState &state)
{
    if (state.pastTime) {
        const QDateTime time = QDateTime::fromMSecsSinceEpoch(*state.pastTime / 1'000'000);
        return KiteText::tr("at %1").arg(time.toString(QStringLiteral("HH:mm:ss.zzz")).chopped(2));
    }
    if (state.isStale)
        return KiteText::tr("stale, %1").arg(QPlcPanelContext::ageText(state.age));
    if (!state.position)
        return KiteText::tr("no position");
    return {};
}

void drawHint(QPainter *painter, const QRectF &area, const QString &text, const QPlcTheme &theme)
{
    painter->setPen(theme.mutedText);
    painter->drawText(area.adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap, text);
}

QColor mixedColor(const QColor &a, const QColor &b, double share)
{
    const auto mix = [share](double from, double to) { return from + (to - from) * share; };
    return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()), mix(a.blueF(), b.blueF()));
}

}  // namespace awe

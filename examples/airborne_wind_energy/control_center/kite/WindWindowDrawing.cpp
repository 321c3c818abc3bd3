// SPDX-License-Identifier: Apache-2.0
#include "WindWindowDrawing.h"

#include "KiteText.h"

#include <QtCore/QtMath>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr double belowHorizon = 5.0;  // [deg] of ground that is seen
constexpr double margin = 8.0;        // [px]

QString windText(double speed)
{
    return KiteText::tr("wind %1 m/s").arg(speed, 0, 'f', 1);
}

}  // namespace

WindWindowFrame::WindWindowFrame(const QSizeF &size, double labelHeight)
{
    const double width = std::max(20.0, size.width() - 2.0 * margin);
    const double height = std::max(20.0, size.height() - labelHeight - 1.5 * margin);
    m_scale = std::min(width / 184.0, height / (91.0 + belowHorizon));
    const double used = m_scale * (91.0 + belowHorizon);
    const double top = margin + 0.5 * (height - used);
    m_origin = QPointF(0.5 * size.width(), top + 91.0 * m_scale);
}

QPointF WindWindowFrame::toPixels(const QPointF &degrees) const
{
    return m_origin + QPointF(degrees.x(), -degrees.y()) * m_scale;
}

QPointF WindWindowFrame::toPixels(const QVector3D &position, float downwind) const
{
    const SkyPosition sky = skyPosition(position);
    return toPixels(windWindowPoint(sky.azimuth, sky.elevation, downwind));
}

QPainterPath kiteSymbol()
{
    QPainterPath path(QPointF(-1.0, 0.35));
    path.cubicTo(QPointF(-0.75, -0.35), QPointF(-0.35, -0.6), QPointF(0.0, -0.6));
    path.cubicTo(QPointF(0.35, -0.6), QPointF(0.75, -0.35), QPointF(1.0, 0.35));
    path.cubicTo(QPointF(0.6, 0.15), QPointF(0.3, 0.05), QPointF(0.0, 0.05));
    path.cubicTo(QPointF(-0.3, 0.05), QPointF(-0.6, 0.15), QPointF(-1.0, 0.35));
    path.closeSubpath();
    return path;
}

WindWindowDrawing::WindWindowDrawing(QPainter *painter, const QSizeF &size, const QPlcTheme &theme)
    : m_painter(painter)
    , m_size(size)
    , m_theme(theme)
    , m_frame(size, QFontMetricsF(painter->font()).height())
{
    painter->setRenderHint(QPainter::Antialiasing);
}

QPainterPath WindWindowDrawing::meridian(int azimuth) const
{
    QPainterPath path;
    for (int elevation = 0; elevation <= 90; elevation += 3) {
        const QPointF point = m_frame.toPixels(windWindowPoint(float(azimuth), float(elevation), 0));
        elevation == 0 ? path.moveTo(point) : path.lineTo(point);
    }
    return path;
}

QPainterPath WindWindowDrawing::parallel(int elevation) const
{
    QPainterPath path;
    for (int azimuth = -90; azimuth <= 90; azimuth += 3) {
        const QPointF point = m_frame.toPixels(windWindowPoint(float(azimuth), float(elevation), 0));
        azimuth == -90 ? path.moveTo(point) : path.lineTo(point);
    }
    return path;
}

void WindWindowDrawing::drawSky()
{
    m_painter->fillRect(QRectF(QPointF(), m_size), m_theme.surface);
    const double radius = 90.0 * m_frame.scale();
    const QPointF origin = m_frame.origin();
    QPainterPath sky(origin + QPointF(radius, 0));
    sky.arcTo(QRectF(origin.x() - radius, origin.y() - radius, 2 * radius, 2 * radius), 0, 180);
    sky.closeSubpath();
    m_painter->fillPath(sky, mixedColor(m_theme.surface, m_theme.accent, m_theme.isDark ? 0.10 : 0.07));

    m_painter->setBrush(Qt::NoBrush);
    m_painter->setPen(QPen(mixedColor(m_theme.surface, m_theme.line, 0.75), 1.0));
    const int step = m_frame.gridStep();
    for (int angle = -90 + step; angle < 90; angle += step)
        m_painter->drawPath(meridian(angle));
    for (int angle = step; angle < 90; angle += step)
        m_painter->drawPath(parallel(angle));
    m_painter->setPen(QPen(m_theme.line, 1.2));
    m_painter->drawPath(sky);

    const QRectF ground(0, origin.y(), m_size.width(), m_size.height() - origin.y());
    m_painter->fillRect(ground, mixedColor(m_theme.surface, m_theme.window, m_theme.isDark ? 0.6 : 0.8));
    m_painter->setPen(QPen(m_theme.mutedText, 1.2));
    m_painter->drawLine(ground.topLeft(), ground.topRight());
    drawLabels();
}

void WindWindowDrawing::drawLabels()
{
    m_painter->setPen(m_theme.mutedText);
    const QFontMetricsF metrics(m_painter->font());
    const double room = m_frame.scale() / metrics.horizontalAdvance(QStringLiteral("-75 deg  "));  // [labels/deg]
    const int step = 15 * room > 1.0 ? 15 : 30;
    // The wind has its name in the middle.
    const double half = 0.5 * metrics.horizontalAdvance(windText(99.9)) + 0.5 / room * m_frame.scale();
    for (int azimuth = -90 + step; azimuth < 90; azimuth += step) {
        const QPointF place = m_frame.toPixels(windWindowPoint(float(azimuth), 0, 0));
        const QRectF box(place.x() - 30, place.y() + 0.5 * belowHorizon * m_frame.scale(), 60, metrics.height());
        if (std::abs(place.x() - m_frame.origin().x()) > half)
            m_painter->drawText(box, Qt::AlignHCenter | Qt::AlignTop, KiteText::tr("%1 deg").arg(azimuth));
    }
    for (int elevation = step; elevation < 90; elevation += step) {
        const QPointF place = m_frame.toPixels(windWindowPoint(0, float(elevation), 0));
        m_painter->drawText(place + QPointF(3, -2), KiteText::tr("%1 deg").arg(elevation));
    }
}

void WindWindowDrawing::drawWind(const KiteState &state)
{
    if (!state.wind)
        return;
    // The tail of an arrow that flies away from whoever looks: a circle with a cross.
    const double radius = std::clamp(3.2 * m_frame.scale(), 4.0, 9.0);
    const QPointF origin = m_frame.origin();
    const double half = radius * M_SQRT1_2;
    m_painter->setBrush(m_theme.surface);
    m_painter->setPen(QPen(m_theme.accent, 1.6));
    m_painter->drawEllipse(origin, radius, radius);
    m_painter->drawLine(origin + QPointF(-half, -half), origin + QPointF(half, half));
    m_painter->drawLine(origin + QPointF(-half, half), origin + QPointF(half, -half));
    const double height = QFontMetricsF(m_painter->font()).height();
    const QRectF box(origin.x() - 90, origin.y() + radius + 1, 180, height);
    m_painter->setPen(m_theme.accent);
    m_painter->drawText(box, Qt::AlignHCenter | Qt::AlignTop, windText(double(state.wind->length())));
}

void WindWindowDrawing::drawTrail(const FlightTrail &trail, const ColorScale &scale, float downwind)
{
    const std::vector<FlightTrail::Point> &points = trail.points();
    QPointF before;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const QPointF place = m_frame.toPixels(points[i].position, downwind);
        if (points[i].isJoined) {
            QColor color = scale.color(double(points[i].value));
            color.setAlphaF(0.4 + 0.6 * double(i + 1) / double(points.size()));
            m_painter->setPen(QPen(color, 1.7 * m_theme.curveWidth, Qt::SolidLine, Qt::FlatCap));
            m_painter->drawLine(before, place);
        }
        before = place;
    }
}

void WindWindowDrawing::drawKite(const KiteState &state)
{
    if (!state.position)
        return;
    const float downwind = state.downwind();
    const QPointF place = m_frame.toPixels(*state.position, downwind);
    QPointF nose(0, 1);
    if (state.course)
        nose = windWindowDirection(*state.position, state.course->rotatedVector({-1, 0, 0}), downwind);
    const double size = std::clamp(6.0 * m_frame.scale(), 10.0, 20.0);
    const bool isStale = state.isStale && !state.pastTime;
    m_painter->save();
    m_painter->translate(place);
    m_painter->rotate(qRadiansToDegrees(std::atan2(nose.x(), nose.y())));
    m_painter->scale(size, size);
    m_painter->setPen(QPen(m_theme.surface, 1.5 / size));
    m_painter->setBrush(isStale ? m_theme.stale : m_theme.text);
    m_painter->drawPath(kiteSymbol());
    m_painter->restore();
}

void WindWindowDrawing::drawCorners(const KiteState &state, const ColorScale &scale, const QString &colorTitle)
{
    // The corners above the half circle are free; in narrow panels there is room for one of them
    // only.
    const QRectF area = QRectF(QPointF(), m_size).adjusted(margin, 0.5 * margin, -margin, 0);
    if (!colorTitle.isEmpty())
        drawColorBar(m_painter, area.topLeft(), scale, colorTitle, m_theme);
    if (m_size.width() >= 320)
        drawReadout(m_painter, area, state, m_theme);
    const QString text = stateText(state);
    if (text.isEmpty())
        return;
    const double height = QFontMetricsF(m_painter->font()).height();
    m_painter->setPen(state.pastTime ? m_theme.accent : state.isStale ? m_theme.warning : m_theme.mutedText);
    m_painter->drawText(QRectF(margin, m_size.height() - height - 2, m_size.width(), height), text);
}

void drawWindWindow(QPainter *painter, const QSizeF &size, const KiteSignals &kite, const QPlcTheme &theme)
{
    painter->setFont(theme.labelFont);
    WindWindowDrawing drawing(painter, size, theme);
    drawing.drawSky();
    const QString problem = kite.problem();
    if (!problem.isEmpty()) {
        QColor veil = theme.surface;
        veil.setAlpha(190);
        painter->fillRect(QRectF(QPointF(), size), veil);
        painter->setFont(theme.font);
        drawHint(painter, QRectF(QPointF(), size), problem, theme);
        return;
    }
    const KiteState state = kite.state();
    FlightTrail trail;
    kite.readTrail(&trail);
    const ColorScale scale = kite.colorScale(trail);
    drawing.drawWind(state);
    drawing.drawTrail(trail, scale, state.downwind());
    drawing.drawKite(state);
    drawing.drawCorners(state, scale, kite.colorTitle());
}

}  // namespace awe

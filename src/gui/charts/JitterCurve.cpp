// SPDX-License-Identifier: Apache-2.0
#include "JitterCurve.h"

#include "ChartLook.h"
#include "gui/models/ValueFormat.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <qwt_scale_map.h>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

constexpr double shortest = 1e-3;  // [us] that a logarithmic axis shows

}  // namespace

JitterCurve::JitterCurve(const JitterDistribution &distribution)
    : QwtPlotItem(QwtText(distribution.title()))
    , m_distribution(distribution)
{
    setZ(20.0);
}

void JitterCurve::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const
{
    const double floor = canvas.bottom();
    QPainterPath outline;
    double end = -1.0;
    for (const JitterDistribution::Bin &bin : m_distribution.bins) {
        const double left = xMap.transform(std::max(bin.low / Microsecond, shortest));
        const double right = xMap.transform(std::max(bin.high / Microsecond, shortest));
        const double top = yMap.transform(bin.count);
        if (left > end + 0.5) {
            if (end >= 0.0)
                outline.lineTo(end, floor);
            outline.moveTo(left, floor);
        }
        outline.lineTo(left, top);
        outline.lineTo(right, top);
        end = right;
    }
    outline.lineTo(end, floor);
    QColor fill = m_color;
    fill.setAlphaF(0.25);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(m_color, 1.0));
    painter->setBrush(fill);
    painter->drawPath(outline);
}

JitterFigures::JitterFigures(const JitterDistribution &distribution, int place)
    : m_distribution(distribution)
    , m_place(place)
{
    setZ(30.0);
}

void JitterFigures::setColors(const QColor &color, const QColor &background)
{
    m_color = color;
    m_background = background;
}

void JitterFigures::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap & /*yMap*/,
                         const QRectF &canvas) const
{
    struct Figure
    {
        const char *name;
        double value;  // [ns]
    };
    const Figure figures[]
        = {{"p50", m_distribution.p50}, {"p99", m_distribution.p99}, {"max", m_distribution.maximum}};
    int line = m_place * int(std::size(figures));
    painter->setFont(scaleFont(painter->font()));
    constexpr int fewestLines = 7;  // with less room, texts would hide what they are about
    const bool isSmall = canvas.height() < fewestLines * QFontMetricsF(painter->font()).height();
    for (const Figure &figure : figures) {
        const double x = xMap.transform(std::max(figure.value / JitterCurve::Microsecond, shortest));
        const QString text = QStringLiteral("%1 %2").arg(QLatin1String(figure.name), durationText(figure.value));
        const bool isTold = !isSmall || figure.value == m_distribution.p99;
        drawFigure(painter, x, isSmall ? m_place : line++, isTold ? text : QString(), canvas);
    }
}

void JitterFigures::drawFigure(QPainter *painter, double x, int line, const QString &text, const QRectF &canvas) const
{
    constexpr double gap = 3.0;  // [px]
    const QFontMetricsF metrics(painter->font());
    QRectF box(0.0, canvas.top() + 2.0 + line * metrics.height(), metrics.horizontalAdvance(text) + 2.0 * gap,
               metrics.height());
    const bool isRoomRight = x + box.width() + gap < canvas.right();
    box.moveLeft(isRoomRight ? x + 1.0 : std::max(x - 1.0 - box.width(), canvas.left()));
    painter->setPen(QPen(m_color, 1.0, Qt::DashLine));
    painter->drawLine(QPointF(x, canvas.bottom()), QPointF(x, box.top()));
    if (text.isEmpty() || box.bottom() > canvas.bottom())
        return;
    QColor background = m_background;
    background.setAlphaF(0.8);
    painter->fillRect(box, background);
    painter->setPen(m_color);
    painter->drawText(box, Qt::AlignCenter, text);
}

}  // namespace qplc

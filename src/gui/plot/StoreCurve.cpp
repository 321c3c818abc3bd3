// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/StoreCurve.h"

#include <QtGui/QPaintEngine>
#include <QtGui/QPainter>

#include <qwt_scale_map.h>

#include <algorithm>
#include <cmath>

namespace qplc {

using Time = SignalStore::Time;
using Point = CurveShape::Point;

namespace {

constexpr double nanosecondsOfSecond = 1e9;
constexpr double farthestY = 1e6;  // [px]

constexpr std::size_t mostSmoothPoints = 300;
constexpr int dashOn = 5;  // lengths, in widths of the line
constexpr int dashOff = 3;
constexpr int dotLength = 2;            // on and off
constexpr double markedOpacity = 0.45;  // of the colour of the curve
constexpr SignalStore::Mark anyMark = 1;

bool isVector(QPaintEngine::Type type)
{
    return type == QPaintEngine::SVG || type == QPaintEngine::Pdf || type == QPaintEngine::Picture;
}

/// From the pixels of a painter to those of its device; when the painter is turned, its own pixels
/// have to do.
QTransform pixelsOf(const QPainter &painter)
{
    const QTransform device = painter.deviceTransform();
    const bool isUpright = device.type() <= QTransform::TxScale && device.m11() > 0.0 && device.m22() > 0.0;
    return isUpright ? device : QTransform();
}

int pixelOf(double position)
{
    const double floored = std::floor(position);
    return floored > -farthestY ? int(std::min(floored, farthestY)) : -int(farthestY);  // also for NaN
}

}  // namespace

/// From values to device pixels of the paint device.
class StoreCurve::PixelScale
{
public:
    PixelScale(const StoreCurve &curve, const QTransform &device, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
               const QRectF &canvas)
        : m_yMap(yMap)
        , m_isLinear(yMap.transformation() == nullptr)
        , m_gain(curve.gain())
        , m_offset(curve.offset())
        , m_scale(device.m22())
        , m_shift(device.dy())
        , m_left(pixelOf(device.m11() * std::min(xMap.p1(), xMap.p2()) + device.dx() + 0.5))
        , m_clip(device.mapRect(canvas).toAlignedRect())
        , m_thickness(std::max(1, int(std::lround(curve.lineWidth() * device.m11()))))
        , m_thinness(std::max(1, int(std::lround(device.m11()))))
    {
        const double y0 = yMap.transform(0.0) * m_scale + m_shift;
        const double slope = (yMap.p2() - yMap.p1()) / (yMap.s2() - yMap.s1()) * m_scale;
        m_factor = m_gain * slope;
        m_zero = y0 + m_offset * slope;
    }

    int left() const { return m_left; }
    int x(int column) const { return m_left + column; }
    int y(float value) const
    {
        if (m_isLinear)
            return pixelOf(m_factor * double(value) + m_zero);
        return pixelOf(m_yMap.transform(m_gain * double(value) + m_offset) * m_scale + m_shift);
    }
    /// The highest and the lowest pixel of a point.
    int top(const Point &point) const { return std::min(y(point.minimum), y(point.maximum)); }
    int bottom(const Point &point) const { return std::max(y(point.minimum), y(point.maximum)); }
    const QRect &clip() const { return m_clip; }
    int thickness() const { return m_thickness; }
    /// Of values with a mark.
    int thinness() const { return m_thinness; }

private:
    const QwtScaleMap &m_yMap;
    bool m_isLinear;
    double m_gain;
    double m_offset;
    double m_scale;  // device pixels of a pixel
    double m_shift;
    double m_factor = 0.0;  // of a linear axis: device pixels for a value
    double m_zero = 0.0;    // of a linear axis: device pixel of value 0
    int m_left;
    QRect m_clip;
    int m_thickness;
    int m_thinness;
};

StoreCurve::StoreCurve(const SignalStore *store, int channel, const QString &title)
    : QwtPlotItem(QwtText(title))
    , m_store(store)
    , m_channel(channel)
{
    setItemAttribute(QwtPlotItem::Legend);
    setZ(20.0);
}

void StoreCurve::setOrigin(Time origin)
{
    m_origin = origin;
    itemChanged();
}

void StoreCurve::setLimits(Time begin, Time end)
{
    m_begin = begin;
    m_end = end;
    itemChanged();
}

void StoreCurve::setScaling(double gain, double offset)
{
    m_gain = gain;
    m_offset = offset;
    itemChanged();
}

void StoreCurve::setColor(const QColor &color)
{
    m_color = color;
    legendChanged();
    itemChanged();
}

void StoreCurve::setLineWidth(double width)
{
    m_lineWidth = width;
    itemChanged();
}

void StoreCurve::setPenStyle(Qt::PenStyle style)
{
    m_penStyle = style;
    legendChanged();
    itemChanged();
}

void StoreCurve::setStyle(Style style)
{
    m_style = style;
    itemChanged();
}

Time StoreCurve::timeAt(double x) const
{
    return m_origin + std::llround(x * nanosecondsOfSecond);
}

SignalStore::Range StoreCurve::valueRange(double begin, double end) const
{
    if (!m_store)
        return {NAN, NAN};
    const SignalStore::Range range = m_store->range(m_channel, m_store->rowAt(std::max(timeAt(begin), m_begin)),
                                                    m_store->rowAt(std::min(timeAt(end), m_end)));
    const auto first = float(m_gain * double(range.minimum) + m_offset);
    const auto second = float(m_gain * double(range.maximum) + m_offset);
    return m_gain < 0.0 ? SignalStore::Range{second, first} : SignalStore::Range{first, second};
}

TimeColumns StoreCurve::columns(const QwtScaleMap &xMap, double scale) const
{
    const int count = std::max(1, int(std::lround(xMap.pDist() * scale)));
    return {timeAt(xMap.s1()), timeAt(xMap.s2()), count};
}

QwtGraphic StoreCurve::legendIcon(int /*index*/, const QSizeF &size) const
{
    return defaultIcon(m_color, size);
}

void StoreCurve::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                      const QRectF &canvasRect) const
{
    if (!m_store || m_store->isEmpty())
        return;
    const QTransform device = pixelsOf(*painter);
    const PixelScale scale(*this, device, xMap, yMap, canvasRect);
    const TimeColumns timeColumns = columns(xMap, device.m11());
    m_shape.read(*m_store, m_channel, timeColumns, m_store->rowAt(m_begin), m_store->rowAt(m_end));
    painter->save();
    painter->setWorldTransform(device.inverted() * painter->worldTransform());  // pixels of the device, one by one
    isDrawnAsLine(*painter) ? drawLines(painter, scale) : drawSpans(painter, scale, dashes(scale, timeColumns));
    painter->restore();
}

/// Columns have numbers for ever, so that dashes move with the curve.
PixelSpans::Dashes StoreCurve::dashes(const PixelScale &scale, const TimeColumns &columns) const
{
    if (m_penStyle == Qt::SolidLine)
        return {};
    const bool isDots = m_penStyle == Qt::DotLine;
    const int on = scale.thickness() * (isDots ? dotLength : dashOn);
    const int off = scale.thickness() * (isDots ? dotLength : dashOff);
    return {on, off, scale.left() - int(columns.first() % (on + off))};
}

/// Where a line is a line, and where a painter's lines look better and are not too slow. Its dashes
/// would begin anew at the edge of each picture.
bool StoreCurve::isDrawnAsLine(const QPainter &painter) const
{
    if (m_shape.isDense())
        return false;
    const bool isSmooth = m_penStyle == Qt::SolidLine && testRenderHint(RenderAntialiased)
        && m_shape.points().size() <= mostSmoothPoints;
    return isSmooth || isVector(painter.paintEngine()->type());
}

void StoreCurve::drawSpans(QPainter *painter, const PixelScale &scale, const PixelSpans::Dashes &dashes) const
{
    m_spans.begin(scale.clip(), scale.thickness(), dashes);
    if (m_shape.hasMarks())
        m_markedSpans.begin(scale.clip(), scale.thinness(), dashes);
    const PixelSpans *before = nullptr;
    const Point *last = nullptr;
    for (const Point &point : m_shape.points()) {
        PixelSpans *spans = point.mark == RowMarks::None ? &m_spans : &m_markedSpans;
        const int x = scale.x(point.x);
        if (!last || !point.isJoined) {
            spans->moveTo(x, scale.top(point), scale.bottom(point));
        } else {
            const int from = scale.y(last->last);
            const int to = scale.y(point.first);
            if (spans != before)
                spans->moveTo(scale.x(last->x), from, from);
            spans->lineTo(scale.x(last->x), from, x, m_style == Steps ? from : to);
            spans->include(scale.top(point), scale.bottom(point));
        }
        before = spans;
        last = &point;
    }
    painter->setRenderHint(QPainter::Antialiasing, false);
    painter->setPen(Qt::NoPen);
    fill(painter, &m_spans, colorOf(RowMarks::None));
    if (m_shape.hasMarks())
        fill(painter, &m_markedSpans, colorOf(anyMark));
}

void StoreCurve::fill(QPainter *painter, PixelSpans *spans, const QColor &color) const
{
    spans->endLine();
    painter->setBrush(color);
    painter->drawRects(spans->rectangles().data(), int(spans->rectangles().size()));
}

void StoreCurve::drawLines(QPainter *painter, const PixelScale &scale) const
{
    if (testRenderHint(RenderAntialiased)) {
        painter->setRenderHint(QPainter::Antialiasing);
        painter->translate(0.5, 0.5);  // smooth lines run between pixels, others through them
    }
    bool isMarked = false;
    painter->setPen(penOf(scale, isMarked));
    m_line.resize(0);
    for (const Point &point : m_shape.points()) {
        if (!point.isJoined)
            flushLine(painter);
        if ((point.mark != RowMarks::None) != isMarked) {
            const QPolygon before = m_line;
            flushLine(painter);
            isMarked = !isMarked;
            painter->setPen(penOf(scale, isMarked));
            if (!before.isEmpty())
                m_line.append(before.last());
        }
        const QPoint next(scale.x(point.x), scale.y(point.last));
        if (m_style == Steps && !m_line.isEmpty())
            m_line.append(QPoint(next.x(), m_line.last().y()));
        m_line.append(next);
    }
    flushLine(painter);
}

QPen StoreCurve::penOf(const PixelScale &scale, bool isMarked) const
{
    const bool isSolid = m_penStyle == Qt::SolidLine;
    QPen pen(colorOf(isMarked ? anyMark : RowMarks::None), isMarked ? scale.thinness() : scale.thickness(),
             Qt::SolidLine, isMarked || !isSolid ? Qt::FlatCap : Qt::SquareCap, Qt::BevelJoin);
    if (m_penStyle == Qt::DashLine)
        pen.setDashPattern({qreal(dashOn), qreal(dashOff)});
    else if (m_penStyle == Qt::DotLine)
        pen.setDashPattern({qreal(dotLength), qreal(dotLength)});
    return pen;
}

QColor StoreCurve::colorOf(SignalStore::Mark mark) const
{
    QColor color = m_color;
    if (mark != RowMarks::None)
        color.setAlphaF(markedOpacity * color.alphaF());
    return color;
}

void StoreCurve::flushLine(QPainter *painter) const
{
    if (m_line.size() == 1)
        painter->drawPoint(m_line.first());
    else if (!m_line.isEmpty())
        painter->drawPolyline(m_line);
    m_line.resize(0);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "XyCanvas.h"

#include "ChartLook.h"
#include "ChartSurface.h"
#include "PlotScales.h"

#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

const QString usualLabel = QStringLiteral("-888.8");
constexpr int usualCharacters = 5;  // of labels of the y axis: canvases do not jump with them

}  // namespace

XyCanvas::XyCanvas(QWidget *parent)
    : QwtPlot(parent)
    , m_grid(std::make_unique<QwtPlotGrid>())
{
    new ChartSurface(this);  // becomes the canvas, which the plot owns
    setMinimumSize(60, 40);
    m_grid->attach(this);
    setAxisScaleDraw(xBottom, new ValueScaleDraw(scaleFont(font()), 0));
    setAxisScaleDraw(yLeft, new ValueScaleDraw(scaleFont(font()), usualCharacters));
    plotLayout()->setAlignCanvasToScales(true);
    setAxisMaxMinor(xBottom, 0);
    setAxisMaxMinor(yLeft, 0);
}

XyCanvas::~XyCanvas()
{
    detachItems(QwtPlotItem::Rtti_PlotItem, false);  // they are ours
}

void XyCanvas::setCurves(std::vector<std::unique_ptr<XyCurve>> curves, const std::vector<QColor> &colors)
{
    for (const std::unique_ptr<XyCurve> &curve : m_curves)
        curve->detach();
    m_curves = std::move(curves);
    m_colors = colors;
    for (const std::unique_ptr<XyCurve> &curve : m_curves)
        curve->attach(this);
    if (!m_isHeld)
        m_x = m_y = Span();
    colorCurves();
    m_xPrefix = m_yPrefix = SiPrefix();
    fitPrefix(xBottom, m_x, &m_xPrefix);
    fitPrefix(yLeft, m_y, &m_yPrefix);
    showTitles();
}

void XyCanvas::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    applyLook(this, m_grid.get(), theme);
    colorCurves();
    showTitles();
}

void XyCanvas::colorCurves()
{
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
        const bool isGiven = i < m_colors.size() && m_colors[i].isValid();
        m_curves[i]->setColor(isGiven ? m_colors[i] : m_theme.curve(int(i)));
        m_curves[i]->setLineWidth(m_theme.curveWidth);
    }
    ++m_looks;
}

void XyCanvas::setAspect(Aspect aspect)
{
    m_aspect = aspect;
    m_isHeld = false;
    m_x = m_y = Span();
    ++m_looks;
}

QString XyCanvas::legend() const
{
    QVector<LegendEntry> entries;
    for (const std::unique_ptr<XyCurve> &curve : m_curves)
        entries.append({curve->title().text(), curve->color()});
    return legendText(entries);
}

/// The signal where all curves have the same, else only the unit they have in common.
QString XyCanvas::axisText(bool isOfX) const
{
    const auto sourceOf = [isOfX](const std::unique_ptr<XyCurve> &curve) -> const QPlcPast & {
        return isOfX ? curve->x() : curve->y();
    };
    if (m_curves.empty())
        return {};
    const QPlcPast &first = sourceOf(m_curves.front());
    const auto areAll = [&](auto isLikeFirst) {
        return std::all_of(m_curves.begin(), m_curves.end(),
                           [&](const auto &curve) { return isLikeFirst(sourceOf(curve)); });
    };
    const bool haveTitle = areAll([&](const QPlcPast &source) { return source.expression == first.expression; });
    return withUnit(haveTitle ? first.text() : QString(), (isOfX ? m_xPrefix : m_yPrefix).unit());
}

QString XyCanvas::commonUnit(bool isOfX) const
{
    std::optional<QString> common;
    for (const std::unique_ptr<XyCurve> &curve : m_curves) {
        const QString &unit = (isOfX ? curve->x() : curve->y()).unit;
        if (common && *common != unit)
            return {};
        common = unit;
    }
    return common.value_or(QString());
}

/// \return whether the title is another one
bool XyCanvas::fitPrefix(QwtPlot::Axis axis, const Span &shown, SiPrefix *prefix)
{
    const QString unit = commonUnit(axis == xBottom);
    const QString before = prefix->unit();
    const double largest = std::max(std::fabs(shown.begin), std::fabs(shown.end));
    *prefix = unit == prefix->tableUnit() ? prefix->kept(largest) : SiPrefix::fitting(unit, largest);
    static_cast<ValueScaleDraw *>(axisScaleDraw(axis))->setFactor(prefix->factor());
    return prefix->unit() != before;
}

void XyCanvas::showTitles()
{
    setAxisText(this, xBottom, axisText(true), m_theme);
    setAxisText(this, yLeft, axisText(false), m_theme);
    ++m_looks;
}

bool XyCanvas::Picture::operator==(const Picture &other) const
{
    const Moment &a = moment;
    const Moment &b = other.moment;
    return a.begin == b.begin && a.end == b.end && a.dot == b.dot && a.isStale == b.isStale && newest == other.newest
        && looks == other.looks;
}

XyCanvas::Picture XyCanvas::pictureOf(const Moment &moment) const
{
    Picture picture{moment, {}, m_looks};
    for (const std::unique_ptr<XyCurve> &curve : m_curves) {
        picture.newest.push_back(curve->x().rowAt(moment.end + 1));
        picture.newest.push_back(curve->y().rowAt(moment.end + 1));
    }
    return picture;
}

bool XyCanvas::show(const Moment &moment)
{
    const Picture picture = pictureOf(moment);
    if (picture == m_picture)
        return false;
    m_picture = picture;
    for (const std::unique_ptr<XyCurve> &curve : m_curves) {
        curve->setTimes(moment.begin, moment.end);
        curve->setDot(moment.dot, moment.isStale ? m_theme.stale : curve->color());
    }
    scaleAxes();
    replot();
    return true;
}

XyCanvas::Span XyCanvas::dataSpan(bool isOfX) const
{
    Span span{INFINITY, -INFINITY};
    for (const std::unique_ptr<XyCurve> &curve : m_curves) {
        const QPlcPast::Range range = isOfX ? curve->xRange() : curve->yRange();
        if (range.isEmpty())
            continue;
        span.begin = std::min(span.begin, double(range.minimum));
        span.end = std::max(span.end, double(range.maximum));
    }
    return span;
}

/// Axes grow at once and shrink only when there is much room, so that they stand still most of the
/// time.
XyCanvas::Span XyCanvas::fitted(Span shown, Span data)
{
    constexpr double margin = 0.08;     // of the data, at each end
    constexpr double leastShare = 0.5;  // of the axis
    if (!(data.begin <= data.end))
        return shown.length() > 0.0 ? shown : Span{0.0, 1.0};
    const bool isInside = data.begin >= shown.begin && data.end <= shown.end;
    if (isInside && shown.length() > 0.0 && data.length() >= leastShare * shown.length())
        return shown;
    const double least = 1e-6 * std::max({std::fabs(data.begin), std::fabs(data.end), 1e-6});
    const double room = data.length() > least ? margin * data.length() : std::max(least, 0.1 * std::fabs(data.end));
    return {data.begin - room, data.end + room};
}

XyCanvas::Span XyCanvas::shownSpan(QwtPlot::Axis axis) const
{
    const QwtInterval shown = axisInterval(axis);
    return {shown.minValue(), shown.maxValue()};
}

/// Not closer than neighbours of 32-bit values are.
void XyCanvas::hold(Span x, Span y)
{
    for (const Span &span : {x, y}) {
        const double largest = std::max(std::fabs(span.begin), std::fabs(span.end));
        if (!(span.length() > 1e-6 * largest) || !std::isfinite(span.length()))
            return;
    }
    m_x = x;
    m_y = y;
    m_isHeld = true;
    ++m_looks;
    show(m_picture.moment);
}

void XyCanvas::zoom(double xFactor, double yFactor, QPointF about)
{
    const QPointF fixed = valueAt(about);
    const auto zoomed = [](Span span, double middle, double factor) {
        return Span{middle + factor * (span.begin - middle), middle + factor * (span.end - middle)};
    };
    const double common = xFactor != 1.0 ? xFactor : yFactor;
    hold(zoomed(shownSpan(xBottom), fixed.x(), m_aspect == Equal ? common : xFactor),
         zoomed(shownSpan(yLeft), fixed.y(), m_aspect == Equal ? common : yFactor));
}

void XyCanvas::pan(QPointF by)
{
    const QPointF shift = valueAt(QPointF()) - valueAt(by);
    const auto moved = [](Span span, double distance) { return Span{span.begin + distance, span.end + distance}; };
    hold(moved(shownSpan(xBottom), shift.x()), moved(shownSpan(yLeft), shift.y()));
}

void XyCanvas::zoomTo(const QRectF &box)
{
    const QPointF low = valueAt(box.bottomLeft());
    const QPointF high = valueAt(box.topRight());
    hold({low.x(), high.x()}, {low.y(), high.y()});
}

void XyCanvas::release()
{
    m_isHeld = false;
    m_x = m_y = Span();
    ++m_looks;
    show(m_picture.moment);
}

QPointF XyCanvas::valueAt(QPointF place) const
{
    return {canvasMap(xBottom).invTransform(place.x()), canvasMap(yLeft).invTransform(place.y())};
}

void XyCanvas::scaleAxes()
{
    if (!m_isHeld) {
        m_x = fitted(m_x, dataSpan(true));
        m_y = fitted(m_y, dataSpan(false));
    }
    // The labels of one axis change the length of the other one: twice is enough.
    for (int i = 0; i < 2; ++i) {
        Span x = m_x;
        Span y = m_y;
        if (m_aspect == Equal)
            makeUnitsEqual(&x, &y);
        const bool isXOther = fitPrefix(xBottom, x, &m_xPrefix);
        if (fitPrefix(yLeft, y, &m_yPrefix) || isXOther)
            showTitles();
        const QFontMetricsF metrics(axisFont(yLeft));
        const QSizeF room = plotLayout()->canvasRect().size();
        setAxisScaleDiv(xBottom, valueScale(x.begin, x.end, room.width(), metrics.horizontalAdvance(usualLabel)));
        setAxisScaleDiv(yLeft, valueScale(y.begin, y.end, room.height(), metrics.height()));
        updateAxes();
        updateLayout();
    }
}

/// Makes the axis longer on which a unit would be longer.
void XyCanvas::makeUnitsEqual(Span *x, Span *y) const
{
    const QRectF rectangle = plotLayout()->canvasRect();
    const double width = std::max(rectangle.width(), 1.0);
    const double height = std::max(rectangle.height(), 1.0);
    const double unitsPerPixel = std::max(x->length() / width, y->length() / height);
    const auto lengthen = [](Span *span, double length) {
        const double room = 0.5 * (length - span->length());
        *span = {span->begin - room, span->end + room};
    };
    lengthen(x, unitsPerPixel * width);
    lengthen(y, unitsPerPixel * height);
}

void XyCanvas::resizeEvent(QResizeEvent *event)
{
    QwtPlot::resizeEvent(event);
    fitAxes(this);
    showTitles();
    show(m_picture.moment);
}

}  // namespace qplc

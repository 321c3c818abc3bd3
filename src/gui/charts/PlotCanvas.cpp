// SPDX-License-Identifier: Apache-2.0
#include "PlotCanvas.h"

#include "ChartLook.h"
#include "ChartSurface.h"
#include "PlotScales.h"

#include <QtCore/QEvent>

#include <qwt_plot_layout.h>
#include <qwt_scale_widget.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double widthsOfLabel = 1.35;  // widths of a label from one to the next on the time axis
constexpr int fewestTicks = 2;
constexpr int usualCharacters = 8;  // of labels of a y axis: -88888.8
constexpr int fewCharacters = 5;

}  // namespace

PlotCanvas::PlotCanvas(QWidget *parent)
    : QwtPlot(parent)
{
    setAutoDelete(false);
    new ChartSurface(this);  // becomes the canvas, which the plot owns
    setAutoFillBackground(true);
    setMinimumSize(1, 1);
    plotLayout()->setAlignCanvasToScales(true);
    plotLayout()->setCanvasMargin(0);
    plotLayout()->setSpacing(2);
    m_grid.enableXMin(false);
    m_grid.attach(this);
    renewScales();
}

void PlotCanvas::renewScales()
{
    const QFont font = scaleFont(this->font());
    m_timeScale = new TimeScaleDraw(font, m_isCompact);
    setAxisScaleDraw(xBottom, m_timeScale);
    axisWidget(xBottom)->setMinBorderDist(m_timeScale->sideRoom(), m_timeScale->sideRoom());
    for (const Axis axis : {Axis::Left, Axis::Right}) {
        setAxisScaleDraw(qwtAxis(axis), new ValueScaleDraw(font, m_isCompact ? fewCharacters : usualCharacters));
        axisWidget(qwtAxis(axis))->setSpacing(1);
        applyNames(axis);
    }
    for (const QwtPlot::Axis axis : {yLeft, yRight, xBottom}) {
        setAxisFont(axis, font);
        axisWidget(axis)->setMargin(0);
    }
}

void PlotCanvas::setTheme(const Theme &theme)
{
    QPalette palette = theme.palette();
    palette.setColor(QPalette::Window, theme.surface);
    palette.setColor(QPalette::WindowText, theme.mutedText);
    palette.setColor(QPalette::Text, theme.mutedText);
    setPalette(palette);
    setCanvasBackground(theme.surface);
    m_grid.setMajorPen(theme.line, 0.0);
    for (const QwtPlot::Axis axis : {yLeft, yRight, xBottom})
        axisWidget(axis)->setPalette(palette);
}

void PlotCanvas::setUnit(Axis axis, const QString &unit)
{
    m_units[axis] = unit;
    showUnits();
}

void PlotCanvas::setNames(Axis axis, const QPlcValueNames &names)
{
    m_names[axis] = names;
    applyNames(axis);
}

void PlotCanvas::setNumbersVisible(Axis axis, bool areVisible)
{
    m_hasNumbers[axis] = areVisible;
    applyNames(axis);
}

void PlotCanvas::applyNames(Axis axis)
{
    auto *draw = static_cast<ValueScaleDraw *>(axisScaleDraw(qwtAxis(axis)));
    draw->setNames(m_names[axis]);
    draw->enableComponent(QwtAbstractScaleDraw::Labels, m_hasNumbers[axis]);
    draw->enableComponent(QwtAbstractScaleDraw::Ticks, m_hasNumbers[axis]);
}

void PlotCanvas::showUnits()
{
    for (const Axis axis : {Axis::Left, Axis::Right}) {
        QwtText title(m_isCompact ? QString() : m_units[axis]);
        title.setFont(scaleFont(font()));
        title.setRenderFlags(Qt::AlignCenter);
        setAxisTitle(qwtAxis(axis), title);
    }
}

void PlotCanvas::setCompact(bool isCompact)
{
    if (isCompact == m_isCompact)
        return;
    m_isCompact = isCompact;
    renewScales();
    showUnits();
}

int PlotCanvas::deviceWidth() const
{
    return std::max(1, qRound(canvasMap(xBottom).pDist() * devicePixelRatioF()));
}

void PlotCanvas::setTime(const TimeColumns &columns, PlotSettings::Labels labels, Time reference,
                         std::optional<Time> event)
{
    m_begin = columns.beginOf(columns.first());
    m_end = std::max(columns.beginOf(columns.end()), m_begin + 1);
    m_origin = beginOfDay(m_begin);
    const int widest = std::max(fewestTicks, int(canvas()->width() / (widthsOfLabel * m_timeScale->usualWidth())));
    const bool isClock = labels == PlotSettings::Labels::Clock;
    const TimeTicks ticks = event ? TimeTicks::aroundEvent(m_begin, m_end, widest, *event)
        : isClock                 ? TimeTicks(m_begin, m_end, widest)
                                  : TimeTicks(m_begin, m_end, widest, reference);
    const auto seconds = [this](const QVector<Time> &times) {
        QList<double> values;
        for (const Time time : times)
            values.append(double(time - m_origin) * 1e-9);
        return values;
    };
    m_timeScale->setTicks(ticks, m_origin);
    setAxisScaleDiv(xBottom,
                    QwtScaleDiv(double(m_begin - m_origin) * 1e-9, double(m_end - m_origin) * 1e-9,
                                seconds(ticks.minor()), {}, seconds(ticks.major())));
}

void PlotCanvas::setRange(Axis axis, double minimum, double maximum, Ticks ticks, double lane)
{
    const QwtPlot::Axis place = qwtAxis(axis);
    const double line = QFontMetricsF(axisFont(place)).height();
    const double height = canvas()->height() - lane;
    QwtScaleDiv scale = valueScale(minimum, maximum, height, line, ticks == WholeTicks ? 1.0 : 0.0);
    if (lane > 0.0 && height > lane)
        scale.setLowerBound(minimum - (maximum - minimum) * lane / height);
    setAxisScaleDiv(place, scale);
}

PlotCanvas::Time PlotCanvas::timeAt(double x) const
{
    const QwtScaleMap map = canvasMap(xBottom);
    const double share = (x - map.p1()) / std::max(map.pDist(), 1.0);
    return m_begin + std::llround(share * double(m_end - m_begin));
}

double PlotCanvas::xOf(Time time) const
{
    const QwtScaleMap map = canvasMap(xBottom);
    return map.p1() + double(time - m_begin) / double(m_end - m_begin) * map.pDist();
}

void PlotCanvas::resizeEvent(QResizeEvent *event)
{
    QwtPlot::resizeEvent(event);
    Q_EMIT resized();
}

void PlotCanvas::changeEvent(QEvent *event)
{
    QwtPlot::changeEvent(event);
    if (event->type() == QEvent::FontChange && m_timeScale)
        renewScales();
}

}  // namespace qplc

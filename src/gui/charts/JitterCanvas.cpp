// SPDX-License-Identifier: Apache-2.0
#include "JitterCanvas.h"

#include "ChartLook.h"
#include "ChartSurface.h"
#include "JitterCurve.h"

#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_engine.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

/// "100 000", and "10⁶" where that is too long.
class CountScale : public QwtScaleDraw
{
public:
    QwtText label(double value) const override
    {
        constexpr double longest = 1e5;
        return value > longest ? QString::number(value, 'g', 2) : QString::number(value, 'f', 0);
    }
};

class TimeScale : public QwtScaleDraw
{
public:
    QwtText label(double value) const override { return QString::number(value, 'g', 6); }
};

}  // namespace

JitterCanvas::JitterCanvas(QWidget *parent)
    : QwtPlot(parent)
    , m_grid(std::make_unique<QwtPlotGrid>())
{
    new ChartSurface(this);  // becomes the canvas, which the plot owns
    setMinimumSize(60, 40);
    setAxisScaleEngine(xBottom, new QwtLogScaleEngine);
    setAxisScaleEngine(yLeft, new QwtLogScaleEngine);
    setAxisScaleDraw(xBottom, new TimeScale);
    setAxisScaleDraw(yLeft, new CountScale);
    setAxisMaxMinor(xBottom, 9);
    setAxisMaxMinor(yLeft, 0);
    plotLayout()->setAlignCanvasToScales(true);
    m_grid->attach(this);
}

JitterCanvas::~JitterCanvas()
{
    detachItems(QwtPlotItem::Rtti_PlotItem, false);  // they are ours
}

void JitterCanvas::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    applyLook(this, m_grid.get(), theme);
    showTitles();
    colorCurves();
    replot();
}

void JitterCanvas::showTitles()
{
    setAxisText(this, xBottom, tr("duration [µs]"), m_theme);
    setAxisText(this, yLeft, tr("count"), m_theme);
}

void JitterCanvas::resizeEvent(QResizeEvent *event)
{
    QwtPlot::resizeEvent(event);
    fitAxes(this);
    showTitles();
    replot();
}

void JitterCanvas::colorCurves()
{
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
        const QColor color = m_isStale ? m_theme.stale : m_theme.curve(int(i));
        m_curves[i]->setColor(color);
        m_figures[i]->setColors(color, m_theme.surface);
    }
}

void JitterCanvas::show(const QVector<JitterDistribution> &distributions, bool isStale)
{
    m_figures.clear();  // items that end leave the plot
    m_curves.clear();
    for (const JitterDistribution &distribution : distributions) {
        m_figures.push_back(std::make_unique<JitterFigures>(distribution, int(m_curves.size())));
        m_figures.back()->attach(this);
        m_curves.push_back(std::make_unique<JitterCurve>(distribution));
        m_curves.back()->attach(this);
    }
    m_isStale = isStale;
    colorCurves();
    scaleAxes(distributions);
    replot();
}

QString JitterCanvas::legend() const
{
    QVector<LegendEntry> entries;
    for (const std::unique_ptr<JitterCurve> &curve : m_curves)
        entries.append({curve->title().text(), curve->color()});
    return legendText(entries);
}

/// Whole powers of ten for counts; time from the shortest to the longest duration, with some room.
void JitterCanvas::scaleAxes(const QVector<JitterDistribution> &distributions)
{
    double shortest = INFINITY;
    double longest = 0.0;
    double most = 1.0;
    for (const JitterDistribution &distribution : distributions) {
        for (const JitterDistribution::Bin &bin : distribution.bins) {
            shortest = std::min(shortest, bin.low);
            longest = std::max(longest, bin.high);
            most = std::max(most, bin.count);
        }
    }
    if (!(shortest < longest))
        return;
    constexpr double least = 1e-3;  // [us]
    constexpr double room = 1.25;
    setAxisScale(xBottom, std::max(shortest / JitterCurve::Microsecond, least) / room,
                 longest / JitterCurve::Microsecond * room);
    setAxisScale(yLeft, 0.5, std::pow(10.0, std::ceil(std::log10(most * 2.0))));
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "BenchPlot.h"

#include "BenchSource.h"

#include <qwt_plot_canvas.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_widget.h>

#include <algorithm>

namespace {

const QColor colors[]{{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}};  // told apart by everyone

constexpr int labelRoom = 40;  // [px]

double secondsOf(qplc::SignalStore::Time time)
{
    return double(time) * 1e-9;
}

}  // namespace

BenchPlot::BenchPlot(const qplc::SignalStore &store, int firstChannel, const PlotBenchOptions &options)
    : m_store(store)
    , m_drawsEveryFrame(options.drawsEveryFrame)
    , m_span(options.points * BenchSource::period)
{
    auto *background = new QwtPlotCanvas(this);
    background->setFrameStyle(QFrame::NoFrame);
    background->setPaintAttribute(QwtPlotCanvas::BackingStore, false);
    background->setPaintAttribute(QwtPlotCanvas::Opaque, true);
    background->setAutoFillBackground(true);
    setCanvas(background);
    setCanvasBackground(Qt::white);
    setAxisTitle(xBottom, QStringLiteral("time [s]"));
    setAxisTitle(yLeft, QStringLiteral("value [m/s]"));
    setAxisScale(yLeft, -2.0, 2.0);
    plotLayout()->setAlignCanvasToScales(true);
    axisWidget(xBottom)->setMinBorderDist(labelRoom,
                                          labelRoom);  // else the canvas shrinks when a label comes near the edge
    auto *grid = new QwtPlotGrid;
    grid->setMajorPen(QColor(225, 225, 225));
    grid->attach(this);
    for (int i = 0; i < options.curves; ++i) {
        auto *curve = new qplc::StoreCurve(&store, firstChannel + i);
        curve->setColor(colors[i % 4]);
        curve->setLineWidth(options.lineWidth);
        curve->attach(this);
        m_curves.push_back(curve);
    }
}

bool BenchPlot::showNewest()
{
    const int width = qRound(canvasMap(xBottom).pDist() * devicePixelRatioF());
    const auto columns = qplc::TimeColumns::upTo(m_store.time(m_store.endRow() - 1), m_span, std::max(1, width));
    if (!m_redraw.isDue(qplc::RedrawRule::Picture::of(m_store, columns)) && !m_drawsEveryFrame)
        return false;
    setAxisScale(xBottom, secondsOf(columns.beginOf(columns.first())), secondsOf(columns.beginOf(columns.end())));
    replot();
    return true;
}

// SPDX-License-Identifier: Apache-2.0
#include "XyInteraction.h"

#include <QtGui/QWheelEvent>
#include <QtWidgets/QRubberBand>

#include <qwt_scale_widget.h>

namespace qplc {

XyInteraction::XyInteraction(QwtPlot *chart, ZoomedAxes *axes, QObject *parent)
    : ChartInteraction(chart, {QwtPlot::yLeft, QwtPlot::xBottom}, parent)
    , m_chart(chart)
    , m_axes(axes)
    , m_box(new QRubberBand(QRubberBand::Rectangle, chart->canvas()))
{
    chart->canvas()->setCursor(Qt::CrossCursor);
    chart->axisWidget(QwtPlot::yLeft)->setCursor(Qt::SizeVerCursor);
    chart->axisWidget(QwtPlot::xBottom)->setCursor(Qt::SizeHorCursor);
}

void XyInteraction::drag(const QWidget *watched, QPoint /*position*/, QPoint by)
{
    const bool isX = watched != m_chart->axisWidget(QwtPlot::yLeft);
    const bool isY = watched != m_chart->axisWidget(QwtPlot::xBottom);
    m_axes->pan(QPointF(isX ? by.x() : 0, isY ? by.y() : 0));
}

void XyInteraction::showBox(const QRect &box)
{
    if (!box.isNull())
        m_box->setGeometry(box);
    m_box->setVisible(!box.isNull());
}

void XyInteraction::chooseBox(const QRect &box)
{
    m_axes->zoomTo(box);
}

void XyInteraction::pinch(double factor, const QPointF &about, const QPointF &by)
{
    m_axes->zoom(factor, factor, about);
    m_axes->pan(by);
}

void XyInteraction::wheel(const QWidget *watched, const QWheelEvent &event)
{
    const double factor = zoomOf(stepsOf(event.angleDelta().y()));
    const bool isOnlyY = watched == m_chart->axisWidget(QwtPlot::yLeft) || (event.modifiers() & Qt::ControlModifier);
    const bool isOnlyX = watched == m_chart->axisWidget(QwtPlot::xBottom);
    m_axes->zoom(isOnlyY ? 1.0 : factor, isOnlyX ? 1.0 : factor, onCanvas(watched, event.position().toPoint()));
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "XyInteraction.h"

#include "gui/panel/PanelAction.h"

#include <QtGui/QWheelEvent>
#include <QtWidgets/QRubberBand>

#include <qwt_scale_widget.h>

namespace qplc {

namespace {

constexpr double zoomOfXyKey = 0.7;  // what a key leaves
constexpr double panOfXyKey = 0.15;  // of the canvas

}  // namespace

XyInteraction::XyInteraction(QwtPlot *chart, ZoomedAxes *axes, QObject *parent)
    : ChartInteraction(chart, {QwtPlot::yLeft, QwtPlot::xBottom}, parent)
    , m_chart(chart)
    , m_axes(axes)
    , m_box(new QRubberBand(QRubberBand::Rectangle, chart->canvas()))
{
    chart->canvas()->setCursor(Qt::CrossCursor);
    chart->axisWidget(QwtPlot::yLeft)->setCursor(Qt::SizeVerCursor);
    chart->axisWidget(QwtPlot::xBottom)->setCursor(Qt::SizeHorCursor);
    connect(this, &XyInteraction::allWanted, this, [this] { m_axes->release(); });
}

/// Zooms are about the mouse, or the middle.
void XyInteraction::addActions(QWidget *panel)
{
    const auto zoom = [this](double factor) {
        return [this, factor] {
            const QPointF middle = QRectF(m_chart->canvas()->rect()).center();
            m_axes->zoom(factor, factor, mouse() ? QPointF(*mouse()) : middle);
        };
    };
    const auto pan = [this](double x, double y) {
        return [this, x, y] {
            const QSizeF size = m_chart->canvas()->size();
            m_axes->pan({x * panOfXyKey * size.width(), y * panOfXyKey * size.height()});
        };
    };
    addPanelAction(
        panel, tr("Show all"), {Qt::Key_A}, [this] { m_axes->release(); }, "all");
    addPanelAction(panel, tr("Zoom in"), {Qt::Key_Plus, Qt::Key_Equal}, zoom(zoomOfXyKey), "zoomIn");
    addPanelAction(panel, tr("Zoom out"), {Qt::Key_Minus}, zoom(1.0 / zoomOfXyKey), "zoomOut");
    addPanelAction(panel, tr("Move left"), {Qt::Key_Left}, pan(1.0, 0.0), "left");
    addPanelAction(panel, tr("Move right"), {Qt::Key_Right}, pan(-1.0, 0.0), "right");
    addPanelAction(panel, tr("Move up"), {Qt::Key_Up}, pan(0.0, 1.0), "up");
    addPanelAction(panel, tr("Move down"), {Qt::Key_Down}, pan(0.0, -1.0), "down");
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

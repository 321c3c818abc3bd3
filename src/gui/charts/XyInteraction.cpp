// SPDX-License-Identifier: Apache-2.0
#include "XyInteraction.h"

#include "PinchZoom.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>
#include <QtWidgets/QRubberBand>

#include <qwt_scale_widget.h>

#include <cmath>

namespace qplc {

namespace {

constexpr double zoomOfStep = 0.8;     // what a step of the wheel leaves
constexpr double stepOfWheel = 120.0;  // [1/8 deg]
constexpr int leastBox = 4;            // [px]: smaller ones are slips

}  // namespace

XyInteraction::XyInteraction(XyCanvas *canvas, QObject *parent)
    : QObject(parent)
    , m_canvas(canvas)
    , m_box(new QRubberBand(QRubberBand::Rectangle, canvas->canvas()))
{
    canvas->canvas()->setMouseTracking(true);
    canvas->canvas()->setCursor(Qt::CrossCursor);
    canvas->canvas()->setContextMenuPolicy(Qt::PreventContextMenu);  // the right button also drags
    canvas->canvas()->installEventFilter(this);
    for (const QwtPlot::Axis axis : {QwtPlot::yLeft, QwtPlot::xBottom})
        canvas->axisWidget(axis)->installEventFilter(this);
    canvas->axisWidget(QwtPlot::yLeft)->setCursor(Qt::SizeVerCursor);
    canvas->axisWidget(QwtPlot::xBottom)->setCursor(Qt::SizeHorCursor);
    followPinches();
}

void XyInteraction::followPinches()
{
    auto *pinch = new PinchZoom(m_canvas->canvas(), this);
    connect(pinch, &PinchZoom::began, this, [this] {
        m_action = Nothing;
        m_isPinching = true;
        m_box->hide();
    });
    connect(pinch, &PinchZoom::zoomed, this, [this](double factor, const QPointF &about, const QPointF &by) {
        m_canvas->zoom(factor, factor, about);
        m_canvas->pan(by);
    });
    connect(pinch, &PinchZoom::ended, this, [this] { m_isPinching = false; });
}

bool XyInteraction::eventFilter(QObject *watched, QEvent *event)
{
    auto *widget = static_cast<QWidget *>(watched);
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        return press(widget, static_cast<QMouseEvent *>(event));
    case QEvent::MouseMove:
        return move(widget, static_cast<QMouseEvent *>(event));
    case QEvent::MouseButtonRelease:
        return release(static_cast<QMouseEvent *>(event));
    case QEvent::MouseButtonDblClick:
        m_action = Nothing;
        Q_EMIT allWanted();
        return true;
    case QEvent::Wheel:
        return wheel(widget, static_cast<QWheelEvent *>(event));
    case QEvent::Leave:
        setMouse(std::nullopt);
        return false;
    default:
        return false;
    }
}

QPoint XyInteraction::onCanvas(const QWidget *watched, QPoint position) const
{
    return watched->mapTo(m_canvas, position) - m_canvas->canvas()->pos();
}

bool XyInteraction::press(QWidget *watched, QMouseEvent *event)
{
    Q_EMIT pressed();
    if (m_action != Nothing || m_isPinching)
        return true;
    const bool isOnCanvas = watched == m_canvas->canvas();
    const bool isBox = event->button() == Qt::RightButton || (event->modifiers() & Qt::ShiftModifier);
    m_button = event->button();
    m_origin = m_last = onCanvas(watched, event->pos());
    m_hasMoved = false;
    m_action = isBox && isOnCanvas ? Box : Pan;
    return true;
}

bool XyInteraction::move(QWidget *watched, QMouseEvent *event)
{
    const QPoint position = onCanvas(watched, event->pos());
    if (watched == m_canvas->canvas())
        setMouse(position);
    if (m_action == Nothing)
        return false;
    m_hasMoved = m_hasMoved || (position - m_origin).manhattanLength() >= QApplication::startDragDistance() / 2;
    if (!m_hasMoved)
        return true;
    const QPoint by = position - m_last;
    m_last = position;
    if (m_action == Box) {
        m_box->setGeometry(QRect(m_origin, position).normalized() & m_canvas->canvas()->rect());
        m_box->show();
    } else {
        const bool isX = watched != m_canvas->axisWidget(QwtPlot::yLeft);
        const bool isY = watched != m_canvas->axisWidget(QwtPlot::xBottom);
        m_canvas->pan(QPointF(isX ? by.x() : 0, isY ? by.y() : 0));
    }
    return true;
}

bool XyInteraction::release(QMouseEvent *event)
{
    if (event->button() != m_button || m_action == Nothing)
        return true;
    const bool isBox = m_action == Box && m_hasMoved;
    m_action = Nothing;
    m_box->hide();
    if (isBox && m_box->width() >= leastBox && m_box->height() >= leastBox)
        m_canvas->zoomTo(m_box->geometry());
    if (!m_hasMoved && m_button == Qt::RightButton)
        Q_EMIT menuWanted(event->globalPos());
    return true;
}

bool XyInteraction::wheel(QWidget *watched, QWheelEvent *event)
{
    const double factor = std::pow(zoomOfStep, event->angleDelta().y() / stepOfWheel);
    const bool isOnlyY = watched == m_canvas->axisWidget(QwtPlot::yLeft) || (event->modifiers() & Qt::ControlModifier);
    const bool isOnlyX = watched == m_canvas->axisWidget(QwtPlot::xBottom);
    m_canvas->zoom(isOnlyY ? 1.0 : factor, isOnlyX ? 1.0 : factor, onCanvas(watched, event->position().toPoint()));
    event->accept();
    return true;
}

void XyInteraction::setMouse(std::optional<QPoint> position)
{
    m_mouse = position;
    Q_EMIT mouseMoved();
}

}  // namespace qplc

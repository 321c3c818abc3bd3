// SPDX-License-Identifier: Apache-2.0
#include "PlotInteraction.h"

#include "PinchZoom.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>

#include <qwt_scale_widget.h>

#include <cmath>
#include <cstdlib>

namespace qplc {

namespace {

constexpr double zoomOfStep = 0.8;     // what a step of the wheel leaves
constexpr double stepOfWheel = 120.0;  // [1/8 deg]
constexpr double panOfStep = 0.1;      // of the view
constexpr int reachOfCursor = 5;       // [px]
constexpr int leastBox = 4;            // [px]: smaller ones are slips

}  // namespace

PlotInteraction::PlotInteraction(PlotCanvas *canvas, QObject *parent)
    : QObject(parent)
    , m_canvas(canvas)
{
    canvas->canvas()->setMouseTracking(true);
    canvas->canvas()->setContextMenuPolicy(Qt::PreventContextMenu);  // the right button also drags
    canvas->canvas()->installEventFilter(this);
    for (const QwtPlot::Axis axis : {QwtPlot::yLeft, QwtPlot::yRight, QwtPlot::xBottom})
        canvas->axisWidget(axis)->installEventFilter(this);
    followPinches();
    canvas->axisWidget(QwtPlot::yLeft)->setCursor(Qt::SizeVerCursor);
    canvas->axisWidget(QwtPlot::yRight)->setCursor(Qt::SizeVerCursor);
}

void PlotInteraction::followPinches()
{
    auto *pinch = new PinchZoom(m_canvas->canvas(), this);
    connect(pinch, &PinchZoom::began, this, [this] {
        m_action = Nothing;
        m_isPinching = true;
        Q_EMIT boxChanged(QRect());
    });
    connect(pinch, &PinchZoom::zoomed, this, [this](double factor, const QPointF &about, const QPointF &by) {
        Q_EMIT zoomTime(factor, m_canvas->timeAt(about.x()));
        Q_EMIT panTime(m_canvas->timeAt(0.0) - m_canvas->timeAt(by.x()));
    });
    connect(pinch, &PinchZoom::ended, this, [this] { m_isPinching = false; });
}

void PlotInteraction::setCursors(std::optional<int> a, std::optional<int> b)
{
    m_cursorA = a;
    m_cursorB = b;
}

bool PlotInteraction::eventFilter(QObject *watched, QEvent *event)
{
    auto *widget = static_cast<QWidget *>(watched);
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        return press(widget, static_cast<QMouseEvent *>(event));
    case QEvent::MouseMove:
        return move(widget, static_cast<QMouseEvent *>(event));
    case QEvent::MouseButtonRelease:
        return release(widget, static_cast<QMouseEvent *>(event));
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

std::optional<PlotInteraction::Axis> PlotInteraction::axisOf(const QWidget *watched) const
{
    if (watched == m_canvas->axisWidget(QwtPlot::yLeft))
        return Axis::Left;
    if (watched == m_canvas->axisWidget(QwtPlot::yRight))
        return Axis::Right;
    return std::nullopt;
}

bool PlotInteraction::press(QWidget *watched, QMouseEvent *event)
{
    Q_EMIT pressed();
    if (m_action != Nothing || m_isPinching)
        return true;
    const QPoint position = watched->mapTo(m_canvas, event->pos()) - m_canvas->canvas()->pos();
    const bool isOnCanvas = watched == m_canvas->canvas();
    const bool isBox = event->button() == Qt::RightButton || (event->modifiers() & Qt::ShiftModifier);
    const std::optional<Axis> axis = axisOf(watched);
    m_button = event->button();
    m_origin = m_last = position;
    m_hasMoved = false;
    m_cursor = isOnCanvas && m_button == Qt::LeftButton ? cursorAt(position.x()) : NoCursor;
    m_axis = axis.value_or(Axis::Left);
    m_action = axis ? PanValues : m_cursor != NoCursor ? DragCursor : isBox && isOnCanvas ? Box : PanTime;
    return true;
}

bool PlotInteraction::move(QWidget *watched, QMouseEvent *event)
{
    const QPoint position = watched->mapTo(m_canvas, event->pos()) - m_canvas->canvas()->pos();
    if (watched == m_canvas->canvas())
        setMouse(position);
    if (m_action == Nothing) {
        showShape(position);
        return false;
    }
    const int distance = (position - m_origin).manhattanLength();
    m_hasMoved = m_hasMoved || m_action == DragCursor || distance >= QApplication::startDragDistance() / 2;
    if (m_hasMoved)
        drag(position);
    return true;
}

void PlotInteraction::drag(QPoint position)
{
    const QPoint by = position - m_last;
    m_last = position;
    switch (m_action) {
    case PanTime:
        m_canvas->canvas()->setCursor(Qt::ClosedHandCursor);
        if (by.x() != 0)
            Q_EMIT panTime(m_canvas->timeAt(0.0) - m_canvas->timeAt(by.x()));
        break;
    case PanValues:
        Q_EMIT panValues(m_axis, by.y());
        break;
    case Box:
        Q_EMIT boxChanged(box(position));
        break;
    case DragCursor:
        Q_EMIT cursorDragged(m_cursor, position.x());
        break;
    case Nothing:
        break;
    }
}

bool PlotInteraction::release(QWidget *watched, QMouseEvent *event)
{
    if (event->button() != m_button || m_action == Nothing)
        return true;
    const QPoint position = watched->mapTo(m_canvas, event->pos()) - m_canvas->canvas()->pos();
    const Action action = m_action;
    m_action = Nothing;
    showShape(position);
    if (action == Box) {
        const QRect chosen = box(position);
        Q_EMIT boxChanged(QRect());
        if (m_hasMoved && chosen.width() >= leastBox && chosen.height() >= leastBox)
            Q_EMIT boxChosen(chosen);
    }
    if (!m_hasMoved && m_button == Qt::RightButton)
        Q_EMIT menuWanted(position, event->globalPos());
    return true;
}

bool PlotInteraction::wheel(QWidget *watched, QWheelEvent *event)
{
    const QPointF position = watched->mapTo(m_canvas, event->position().toPoint()) - m_canvas->canvas()->pos();
    const QPoint turn = event->angleDelta();
    const bool isSideways = std::abs(turn.x()) > std::abs(turn.y()) || (event->modifiers() & Qt::ShiftModifier);
    const double steps = (std::abs(turn.x()) > std::abs(turn.y()) ? turn.x() : turn.y()) / stepOfWheel;
    const double factor = std::pow(zoomOfStep, steps);
    const std::optional<Axis> axis = axisOf(watched);
    if (axis) {
        Q_EMIT zoomValues(*axis, factor, position.y());
    } else if (event->modifiers() & Qt::ControlModifier) {
        for (const Axis each : {Axis::Left, Axis::Right})
            Q_EMIT zoomValues(each, factor, position.y());
    } else if (isSideways) {
        Q_EMIT panTime(-qint64(std::llround(steps * panOfStep * double(m_canvas->end() - m_canvas->begin()))));
    } else {
        Q_EMIT zoomTime(factor, m_canvas->timeAt(position.x()));
    }
    event->accept();
    return true;
}

QRect PlotInteraction::box(QPoint position) const
{
    return QRect(m_origin, position).normalized() & m_canvas->canvas()->rect();
}

PlotInteraction::Cursor PlotInteraction::cursorAt(int x) const
{
    const auto distance = [x](std::optional<int> cursor) { return cursor ? std::abs(x - *cursor) : reachOfCursor + 1; };
    if (distance(m_cursorA) > reachOfCursor && distance(m_cursorB) > reachOfCursor)
        return NoCursor;
    return distance(m_cursorB) <= distance(m_cursorA) ? CursorB : CursorA;
}

void PlotInteraction::showShape(QPoint position)
{
    const bool isOnCursor = cursorAt(position.x()) != NoCursor;
    m_canvas->canvas()->setCursor(isOnCursor ? Qt::SplitHCursor : Qt::CrossCursor);
}

void PlotInteraction::setMouse(std::optional<QPoint> position)
{
    m_mouse = position;
    Q_EMIT mouseMoved();
}

}  // namespace qplc

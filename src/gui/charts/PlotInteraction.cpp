// SPDX-License-Identifier: Apache-2.0
#include "PlotInteraction.h"

#include <QtGui/QWheelEvent>

#include <qwt_scale_widget.h>

#include <cmath>
#include <cstdlib>

namespace qplc {

namespace {

constexpr double panOfStep = 0.1;  // of the view
constexpr int reachOfCursor = 5;   // [px]

}  // namespace

PlotInteraction::PlotInteraction(PlotCanvas *canvas, QObject *parent)
    : ChartInteraction(canvas, {QwtPlot::yLeft, QwtPlot::yRight, QwtPlot::xBottom}, parent)
    , m_canvas(canvas)
{
    connect(canvas, &PlotCanvas::scaleAdded, this, [this](QWidget *scale) { scale->installEventFilter(this); });
    canvas->axisWidget(QwtPlot::yLeft)->setCursor(Qt::SizeVerCursor);
    canvas->axisWidget(QwtPlot::yRight)->setCursor(Qt::SizeVerCursor);
}

void PlotInteraction::setCursors(std::optional<int> a, std::optional<int> b)
{
    m_cursorA = a;
    m_cursorB = b;
}

PlotInteraction::Begin PlotInteraction::begin(const QWidget *watched, QPoint position, Qt::MouseButton button)
{
    const bool canTake = watched == m_canvas->canvas() && button == Qt::LeftButton;
    m_cursor = canTake ? cursorAt(position.x()) : NoCursor;
    return m_cursor != NoCursor ? DragAtOnce : BoxOrDrag;
}

void PlotInteraction::drag(const QWidget *watched, QPoint position, QPoint by)
{
    if (m_cursor != NoCursor) {
        Q_EMIT cursorDragged(m_cursor, position.x());
    } else if (const Axis axis = m_canvas->axisOf(watched); axis >= 0) {
        Q_EMIT panValues(axis, by.y());
    } else {
        m_canvas->canvas()->setCursor(Qt::ClosedHandCursor);
        if (by.x() != 0)
            pan(by.x());
    }
}

/// \param x  [px], > 0: to earlier times
void PlotInteraction::pan(double x)
{
    Q_EMIT panTime(m_canvas->timeAt(0.0) - m_canvas->timeAt(x));
}

void PlotInteraction::pinch(double factor, const QPointF &about, const QPointF &by)
{
    Q_EMIT zoomTime(factor, m_canvas->timeAt(about.x()));
    pan(by.x());
}

void PlotInteraction::wheel(const QWidget *watched, const QWheelEvent &event)
{
    const QPointF position = onCanvas(watched, event.position().toPoint());
    const QPoint turn = event.angleDelta();
    const bool isTilted = std::abs(turn.x()) > std::abs(turn.y());
    const double steps = stepsOf(isTilted ? turn.x() : turn.y());
    const double factor = zoomOf(steps);
    if (const Axis axis = m_canvas->axisOf(watched); axis >= 0) {
        Q_EMIT zoomValues(axis, factor, position.y());
    } else if (event.modifiers() & Qt::ControlModifier) {
        for (Axis each = 0; each < m_canvas->axisCount(); ++each)
            Q_EMIT zoomValues(each, factor, position.y());
    } else if (isTilted || (event.modifiers() & Qt::ShiftModifier)) {
        Q_EMIT panTime(-qint64(std::llround(steps * panOfStep * double(m_canvas->end() - m_canvas->begin()))));
    } else {
        Q_EMIT zoomTime(factor, m_canvas->timeAt(position.x()));
    }
}

PlotInteraction::Cursor PlotInteraction::cursorAt(int x) const
{
    const auto distance = [x](std::optional<int> cursor) { return cursor ? std::abs(x - *cursor) : reachOfCursor + 1; };
    if (distance(m_cursorA) > reachOfCursor && distance(m_cursorB) > reachOfCursor)
        return NoCursor;
    return distance(m_cursorB) <= distance(m_cursorA) ? CursorB : CursorA;
}

void PlotInteraction::hover(QPoint position)
{
    const bool isOnCursor = cursorAt(position.x()) != NoCursor;
    m_canvas->canvas()->setCursor(isOnCursor ? Qt::SplitHCursor : Qt::CrossCursor);
}

}  // namespace qplc

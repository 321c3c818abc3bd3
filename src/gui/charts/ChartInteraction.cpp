// SPDX-License-Identifier: Apache-2.0
#include "ChartInteraction.h"

#include "PinchZoom.h"
#include "gui/panel/DragEscape.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>

#include <qwt_scale_widget.h>

#include <cmath>

namespace qplc {

namespace {

constexpr double zoomOfStep = 0.8;     // what a step of the wheel leaves
constexpr double angleOfStep = 120.0;  // [1/8 deg]
constexpr int leastBox = 4;            // [px]: smaller ones are slips

}  // namespace

ChartInteraction::ChartInteraction(QwtPlot *chart, std::initializer_list<QwtPlot::Axis> axes, QObject *parent)
    : QObject(parent)
    , m_chart(chart)
{
    chart->canvas()->setMouseTracking(true);
    chart->canvas()->setContextMenuPolicy(Qt::PreventContextMenu);  // the right button also drags
    chart->canvas()->installEventFilter(this);
    for (const QwtPlot::Axis axis : axes)
        chart->axisWidget(axis)->installEventFilter(this);
    followPinches();
    auto *escape = new DragEscape(chart->canvas(), this);
    for (const QwtPlot::Axis axis : axes)
        escape->watch(chart->axisWidget(axis));
    connect(escape, &DragEscape::escaped, this, &ChartInteraction::endDrag);
}

void ChartInteraction::followPinches()
{
    auto *fingers = new PinchZoom(m_chart->canvas(), this);
    connect(fingers, &PinchZoom::began, this, [this] {
        m_action = Nothing;
        m_isPinching = true;
        showBox(QRect());
    });
    connect(fingers, &PinchZoom::zoomed, this, &ChartInteraction::pinch);
    connect(fingers, &PinchZoom::ended, this, [this] { m_isPinching = false; });
}

bool ChartInteraction::eventFilter(QObject *watched, QEvent *event)
{
    const auto *widget = static_cast<QWidget *>(watched);
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        press(widget, *static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseMove:
        return move(widget, *static_cast<QMouseEvent *>(event));
    case QEvent::MouseButtonRelease:
        release(widget, *static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseButtonDblClick:
        m_action = Nothing;
        Q_EMIT allWanted();
        return true;
    case QEvent::Wheel:
        wheel(widget, *static_cast<QWheelEvent *>(event));
        event->accept();
        return true;
    case QEvent::Leave:
        setMouse(std::nullopt);
        return false;
    default:
        return false;
    }
}

ChartInteraction::Begin ChartInteraction::begin(const QWidget * /*watched*/, QPoint /*position*/,
                                                Qt::MouseButton /*button*/)
{
    return BoxOrDrag;
}

void ChartInteraction::hover(QPoint /*position*/) {}

QPoint ChartInteraction::onCanvas(const QWidget *watched, QPoint position) const
{
    return watched->mapTo(m_chart, position) - m_chart->canvas()->pos();
}

double ChartInteraction::stepsOf(int angle)
{
    return angle / angleOfStep;
}

double ChartInteraction::zoomOf(double steps)
{
    return std::pow(zoomOfStep, steps);
}

void ChartInteraction::press(const QWidget *watched, const QMouseEvent &event)
{
    Q_EMIT pressed();
    if (m_action != Nothing || m_isPinching)
        return;
    const bool isBox = event.button() == Qt::RightButton || (event.modifiers() & Qt::ShiftModifier);
    m_button = event.button();
    m_origin = m_last = onCanvas(watched, event.pos());
    const Begin how = begin(watched, m_origin, m_button);
    m_hasMoved = how == DragAtOnce;
    m_action = how == BoxOrDrag && isBox && watched == m_chart->canvas() ? Boxing : Dragging;
}

bool ChartInteraction::move(const QWidget *watched, const QMouseEvent &event)
{
    const QPoint position = onCanvas(watched, event.pos());
    if (watched == m_chart->canvas())
        setMouse(position);
    if (m_action == Nothing) {
        hover(position);
        return false;
    }
    m_hasMoved = m_hasMoved || (position - m_origin).manhattanLength() >= QApplication::startDragDistance() / 2;
    if (!m_hasMoved)
        return true;
    const QPoint by = position - m_last;
    m_last = position;
    if (m_action == Boxing)
        showBox(boxTo(position));
    else
        drag(watched, position, by);
    return true;
}

void ChartInteraction::release(const QWidget *watched, const QMouseEvent &event)
{
    if (event.button() != m_button || m_action == Nothing)
        return;
    const QPoint position = onCanvas(watched, event.pos());
    const bool isBox = m_action == Boxing;
    m_action = Nothing;
    hover(position);
    if (isBox) {
        const QRect box = boxTo(position);
        showBox(QRect());
        if (m_hasMoved && box.width() >= leastBox && box.height() >= leastBox)
            chooseBox(box);
    }
    if (!m_hasMoved && m_button == Qt::LeftButton && watched == m_chart->canvas())
        Q_EMIT clicked(position);
    if (!m_hasMoved && m_button == Qt::RightButton)
        Q_EMIT menuWanted(position, event.globalPos());
}

/// As if it had been a slip: the chart stays where it is, and a box chooses nothing.
void ChartInteraction::endDrag()
{
    if (m_action == Nothing)
        return;
    m_action = Nothing;
    showBox(QRect());
    hover(m_last);
}

QRect ChartInteraction::boxTo(QPoint position) const
{
    return QRect(m_origin, position).normalized() & m_chart->canvas()->rect();
}

void ChartInteraction::setMouse(std::optional<QPoint> position)
{
    m_mouse = position;
    Q_EMIT mouseMoved();
}

}  // namespace qplc

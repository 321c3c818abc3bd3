// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QPoint>
#include <QtCore/QRect>

#include <qwt_plot.h>

#include <initializer_list>
#include <optional>

class QMouseEvent;
class QWheelEvent;

namespace qplc {

/// What a mouse and two fingers do over a chart, the same in all of them: dragging with Shift or
/// the right button is a box, other dragging is up to the chart; a double click wants all, the
/// right button alone a menu. Escape ends what is dragged. All places are in pixels of the canvas.
class ChartInteraction : public QObject
{
    Q_OBJECT
public:
    /// Where the mouse is over the canvas; empty: elsewhere.
    std::optional<QPoint> mouse() const { return m_mouse; }

Q_SIGNALS:
    void pressed();
    /// The left button, without dragging.
    void clicked(const QPoint &position);
    void mouseMoved();
    void allWanted();
    void menuWanted(const QPoint &position, const QPoint &global);

protected:
    enum Begin { BoxOrDrag, Drag, DragAtOnce };

    /// \param axes  that hear the mouse, too
    ChartInteraction(QwtPlot *chart, std::initializer_list<QwtPlot::Axis> axes, QObject *parent);

    bool eventFilter(QObject *watched, QEvent *event) override;

    /// A button goes down on the canvas or an axis.
    virtual Begin begin(const QWidget *watched, QPoint position, Qt::MouseButton button);
    virtual void drag(const QWidget *watched, QPoint position, QPoint by) = 0;
    /// Null: there is none, any more.
    virtual void showBox(const QRect &box) = 0;
    virtual void chooseBox(const QRect &box) = 0;
    /// The mouse is here, and drags nothing.
    virtual void hover(QPoint position);
    /// See PinchZoom::zoomed().
    virtual void pinch(double factor, const QPointF &about, const QPointF &by) = 0;
    virtual void wheel(const QWidget *watched, const QWheelEvent &event) = 0;

    QPoint onCanvas(const QWidget *watched, QPoint position) const;
    /// Steps of a wheel. \param angle  as QWheelEvent has it
    static double stepsOf(int angle);
    /// What steps of a wheel leave of what is seen.
    static double zoomOf(double steps);

private:
    enum Action { Nothing, Dragging, Boxing };

    void press(const QWidget *watched, const QMouseEvent &event);
    bool move(const QWidget *watched, const QMouseEvent &event);
    void release(const QWidget *watched, const QMouseEvent &event);
    void endDrag();
    QRect boxTo(QPoint position) const;
    void followPinches();
    void setMouse(std::optional<QPoint> position);

    QwtPlot *m_chart;
    std::optional<QPoint> m_mouse;
    Action m_action = Nothing;
    bool m_isPinching = false;  // what a mouse does is by the first finger
    Qt::MouseButton m_button = Qt::NoButton;
    QPoint m_origin;  // of the drag
    QPoint m_last;
    bool m_hasMoved = false;
};

}  // namespace qplc

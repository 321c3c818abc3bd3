// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotCanvas.h"

#include <QtCore/QObject>

#include <optional>

class QMouseEvent;
class QWheelEvent;

namespace qplc {

/// Turns what a mouse does over a plot into wishes, in pixels of its canvas and in times.
///
/// The wheel zooms about the mouse, with Ctrl or over a y axis the values; dragging pans, over a y axis the values; dragging with Shift or the right button is a box; cursors are dragged; a double click wants
/// all; the right button alone wants a menu. Two fingers zoom and pan the time.
class PlotInteraction : public QObject
{
    Q_OBJECT
public:
    using Time = PlotCanvas::Time;
    using Axis = PlotCanvas::Axis;
    enum Cursor { NoCursor, CursorA, CursorB };

    PlotInteraction(PlotCanvas *canvas, QObject *parent);

    /// Where cursors can be taken [px].
    void setCursors(std::optional<int> a, std::optional<int> b);
    /// Where the mouse is over the canvas [px]; empty: elsewhere.
    std::optional<QPoint> mouse() const { return m_mouse; }
    /// The one that is dragged.
    Cursor draggedCursor() const { return m_action == DragCursor ? m_cursor : NoCursor; }

Q_SIGNALS:
    void zoomTime(double factor, qint64 about);
    void panTime(qint64 by);
    /// \param about  [px] from the top of the canvas
    void zoomValues(qplc::PlotCurveSettings::Axis axis, double factor, double about);
    /// \param by  [px], > 0: downwards
    void panValues(qplc::PlotCurveSettings::Axis axis, double by);
    /// Null: there is none, any more.
    void boxChanged(const QRect &box);
    void boxChosen(const QRect &box);
    void cursorDragged(qplc::PlotInteraction::Cursor cursor, double x);
    void mouseMoved();
    void allWanted();
    void menuWanted(const QPoint &position, const QPoint &global);
    void pressed();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    enum Action { Nothing, PanTime, PanValues, Box, DragCursor };

    bool press(QWidget *watched, QMouseEvent *event);
    bool move(QWidget *watched, QMouseEvent *event);
    bool release(QWidget *watched, QMouseEvent *event);
    bool wheel(QWidget *watched, QWheelEvent *event);
    void followPinches();
    void drag(QPoint position);
    QRect box(QPoint position) const;
    Cursor cursorAt(int x) const;
    void showShape(QPoint position);
    std::optional<Axis> axisOf(const QWidget *watched) const;
    void setMouse(std::optional<QPoint> position);

    PlotCanvas *m_canvas;
    std::optional<int> m_cursorA;
    std::optional<int> m_cursorB;
    std::optional<QPoint> m_mouse;
    Action m_action = Nothing;
    Cursor m_cursor = NoCursor;
    Axis m_axis = Axis::Left;
    Qt::MouseButton m_button = Qt::NoButton;
    QPoint m_origin;  // of the drag
    QPoint m_last;
    bool m_hasMoved = false;
    bool m_isPinching = false;  // what a mouse does is by the first finger
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartInteraction.h"
#include "PlotCanvas.h"

namespace qplc {

/// Turns what a mouse does over a plot into wishes, in pixels of its canvas and in times.
///
/// The wheel zooms about the mouse, with Ctrl or over a y axis the values; dragging pans, over a y
/// axis the values; cursors are dragged. Two fingers zoom and pan the time.
class PlotInteraction : public ChartInteraction
{
    Q_OBJECT
public:
    using Time = PlotCanvas::Time;
    using Axis = PlotCanvas::Axis;
    enum Cursor { NoCursor, CursorA, CursorB };

    PlotInteraction(PlotCanvas *canvas, QObject *parent);

    /// Where cursors can be taken [px].
    void setCursors(std::optional<int> a, std::optional<int> b);
    /// The one that is dragged.

Q_SIGNALS:
    void zoomTime(double factor, qint64 about);
    void panTime(qint64 by);
    /// \param about  [px] from the top of the canvas
    void zoomValues(int axis, double factor, double about);
    /// \param by  [px], > 0: downwards
    void panValues(int axis, double by);
    /// Null: there is none, any more.
    void boxChanged(const QRect &box);
    void boxChosen(const QRect &box);
    void cursorDragged(qplc::PlotInteraction::Cursor cursor, double x);

protected:
    Begin begin(const QWidget *watched, QPoint position, Qt::MouseButton button) override;
    void drag(const QWidget *watched, QPoint position, QPoint by) override;
    void showBox(const QRect &box) override { Q_EMIT boxChanged(box); }
    void chooseBox(const QRect &box) override { Q_EMIT boxChosen(box); }
    void hover(QPoint position) override;
    void pinch(double factor, const QPointF &about, const QPointF &by) override;
    void wheel(const QWidget *watched, const QWheelEvent &event) override;

private:
    Cursor cursorAt(int x) const;
    void pan(double x);

    PlotCanvas *m_canvas;
    std::optional<int> m_cursorA;
    std::optional<int> m_cursorB;
    Cursor m_cursor = NoCursor;  // that the drag has taken
};

}  // namespace qplc

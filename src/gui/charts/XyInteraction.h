// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartInteraction.h"
#include "XyCanvas.h"

class QRubberBand;

namespace qplc {

/// What a mouse and two fingers do over an XY plot, beside what they do over all charts: the wheel
/// zooms about the mouse, over an axis only its values, with Ctrl those of y; dragging pans, over
/// an axis only its values; a box is zoomed into.
class XyInteraction : public ChartInteraction
{
    Q_OBJECT
public:
    XyInteraction(XyCanvas *canvas, QObject *parent);

protected:
    void drag(const QWidget *watched, QPoint position, QPoint by) override;
    void showBox(const QRect &box) override;
    void chooseBox(const QRect &box) override;
    void pinch(double factor, const QPointF &about, const QPointF &by) override;
    void wheel(const QWidget *watched, const QWheelEvent &event) override;

private:
    XyCanvas *m_canvas;
    QRubberBand *m_box;  // of the canvas
};

}  // namespace qplc

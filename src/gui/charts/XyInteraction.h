// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartInteraction.h"
#include "ZoomedAxes.h"

class QRubberBand;

namespace qplc {

/// What a mouse and two fingers do over a chart whose axes are both values, beside what they do
/// over all charts: the wheel zooms about the mouse, over an axis only its values, with Ctrl those
/// of y; dragging pans, over an axis only its values; a box is zoomed into; a double click shows
/// all. Keys do the same.
class XyInteraction : public ChartInteraction
{
    Q_OBJECT
public:
    /// \param axes  those of the chart
    XyInteraction(QwtPlot *chart, ZoomedAxes *axes, QObject *parent);

    /// Adds what the keys do to the actions of the panel: "all", "zoomIn" and so on.
    void addActions(QWidget *panel);

protected:
    void drag(const QWidget *watched, QPoint position, QPoint by) override;
    void showBox(const QRect &box) override;
    void chooseBox(const QRect &box) override;
    void pinch(double factor, const QPointF &about, const QPointF &by) override;
    void wheel(const QWidget *watched, const QWheelEvent &event) override;

private:
    QwtPlot *m_chart;
    ZoomedAxes *m_axes;
    QRubberBand *m_box;  // of the canvas
};

}  // namespace qplc

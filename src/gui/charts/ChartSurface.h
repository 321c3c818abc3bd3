// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QPixmap>
#include <QtWidgets/QWidget>

class QwtPlot;

namespace qplc {

/// The area of a chart that shows curves. Keeps the last picture, so that cursors move over it
/// without drawing the curves again.
///
/// The picture covers every device pixel, at any scale factor. The area does not claim to be
/// opaque: at 150 %, edges lie between pixels, and Qt would leave there what was on the screen
/// before.
class ChartSurface : public QWidget
{
    Q_OBJECT
public:
    /// Becomes the canvas of \a plot.
    explicit ChartSurface(QwtPlot *plot);

public Q_SLOTS:
    /// QwtPlot::replot() calls this by its name.
    void replot();

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void drawPicture();

    QwtPlot *m_plot;
    QPixmap m_picture;
};

}  // namespace qplc

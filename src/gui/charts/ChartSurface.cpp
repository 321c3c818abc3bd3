// SPDX-License-Identifier: Apache-2.0
#include "ChartSurface.h"

#include <QtGui/QPainter>

#include <qwt_plot.h>

#include <cmath>

namespace qplc {

ChartSurface::ChartSurface(QwtPlot *plot)
    : QWidget(plot)
    , m_plot(plot)
{
    setAutoFillBackground(true);
    setFocusPolicy(Qt::NoFocus);
    setCursor(Qt::CrossCursor);
    plot->setCanvas(this);
}

void ChartSurface::replot()
{
    m_picture = QPixmap();
    update();
}

void ChartSurface::drawPicture()
{
    const double ratio = devicePixelRatioF();
    const QSize pixels(int(std::ceil(width() * ratio)), int(std::ceil(height() * ratio)));
    if (m_picture.size() == pixels && m_picture.devicePixelRatioF() == ratio)
        return;
    m_picture = QPixmap(pixels);
    m_picture.setDevicePixelRatio(ratio);
    m_picture.fill(palette().color(backgroundRole()));
    QPainter painter(&m_picture);
    painter.setClipRect(rect());
    m_plot->drawCanvas(&painter);
}

void ChartSurface::paintEvent(QPaintEvent * /*event*/)
{
    drawPicture();
    QPainter painter(this);
    painter.drawPixmap(0, 0, m_picture);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "PlotPicture.h"

#include "PlotCanvas.h"
#include "PlotLegend.h"
#include "PlotOverlay.h"

#include <QtGui/QPainter>

namespace qplc {

PlotPicture::PlotPicture(PlotCanvas *canvas, const PlotOverlay *overlay, const PlotLegend *legend)
    : ChartPicture(canvas)
    , m_canvas(canvas)
    , m_overlay(overlay)
    , m_legend(legend)
{
}

QSize PlotPicture::size() const
{
    return {m_canvas->width(), m_canvas->height() + (m_legend->isHidden() ? 0 : m_legend->height())};
}

void PlotPicture::paint(QPainter *painter) const
{
    paintPlot(painter);
    m_canvas->paintFurtherAxes(painter);
    painter->save();
    painter->translate(m_canvas->canvas()->pos());
    painter->setClipRect(m_canvas->canvas()->rect());
    m_overlay->paint(painter);
    painter->restore();
    if (m_legend->isHidden())
        return;
    painter->translate(0, m_canvas->height());
    m_legend->paint(painter, false);
}

}  // namespace qplc

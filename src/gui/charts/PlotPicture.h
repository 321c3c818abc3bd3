// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartPicture.h"

namespace qplc {

class PlotCanvas;
class PlotLegend;
class PlotOverlay;

/// Pictures of a time plot with its legend and cursors.
class PlotPicture : public ChartPicture
{
public:
    PlotPicture(PlotCanvas *canvas, const PlotOverlay *overlay, const PlotLegend *legend);

protected:
    QSize size() const override;
    void paint(QPainter *painter) const override;

private:
    PlotCanvas *m_canvas;
    const PlotOverlay *m_overlay;
    const PlotLegend *m_legend;
};

}  // namespace qplc

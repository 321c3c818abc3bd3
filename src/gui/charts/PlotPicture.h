// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QImage>

namespace qplc {

class PlotCanvas;
class PlotLegend;
class PlotOverlay;

/// Pictures of a plot with its legend and cursors, drawn anew at any size: as pixels for screens of high density, or as vectors.
class PlotPicture
{
public:
    static constexpr int scale = 2;  // pixels of a picture for each of the window

    PlotPicture(PlotCanvas *canvas, const PlotOverlay *overlay, const PlotLegend *legend);

    QImage image() const;
    /// By the ending of the name: ".svg" for vectors, else ".png". \return a sentence when it failed
    QString save(const QString &fileName) const;

private:
    QSize size() const;
    void paint(QPainter *painter) const;
    QByteArray svg() const;

    PlotCanvas *m_canvas;
    const PlotOverlay *m_overlay;
    const PlotLegend *m_legend;
};

}  // namespace qplc

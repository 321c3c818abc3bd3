// SPDX-License-Identifier: Apache-2.0
#include "PlotPicture.h"

#include "PlotCanvas.h"
#include "PlotLegend.h"
#include "PlotOverlay.h"

#include <QtCore/QBuffer>
#include <QtCore/QSaveFile>
#include <QtGui/QPainter>
#include <QtSvg/QSvgGenerator>

#include <qwt_plot_renderer.h>

namespace qplc {

PlotPicture::PlotPicture(PlotCanvas *canvas, const PlotOverlay *overlay, const PlotLegend *legend)
    : m_canvas(canvas)
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
    painter->fillRect(QRect(QPoint(), size()), m_canvas->palette().window());
    QwtPlotRenderer renderer;
    renderer.setDiscardFlag(QwtPlotRenderer::DiscardBackground);
    renderer.setDiscardFlag(QwtPlotRenderer::DiscardCanvasBackground);
    renderer.render(m_canvas, painter, QRectF(QPointF(), m_canvas->size()));
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

QImage PlotPicture::image() const
{
    QImage image(size() * scale, QImage::Format_RGB32);
    image.setDevicePixelRatio(scale);
    QPainter painter(&image);
    paint(&painter);
    return image;
}

QByteArray PlotPicture::svg() const
{
    QBuffer buffer;
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setResolution(m_canvas->logicalDpiX());
    generator.setSize(size());
    generator.setViewBox(QRect(QPoint(), size()));
    QPainter painter(&generator);
    paint(&painter);
    painter.end();
    return buffer.data();
}

QString PlotPicture::save(const QString &fileName) const
{
    QSaveFile file(fileName);
    bool isWritten = file.open(QIODevice::WriteOnly);
    if (isWritten && fileName.endsWith(QLatin1String(".svg"), Qt::CaseInsensitive)) {
        const QByteArray text = svg();
        isWritten = file.write(text) == text.size();
    } else if (isWritten) {
        isWritten = image().save(&file, "PNG");
    }
    if (isWritten && file.commit())
        return {};
    return PlotCanvas::tr("%1 cannot be written: %2. Choose another place.").arg(fileName, file.errorString());
}

}  // namespace qplc

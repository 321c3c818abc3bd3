// SPDX-License-Identifier: Apache-2.0
#include "ChartPicture.h"

#include "ChartLook.h"

#include <QtCore/QBuffer>
#include <QtCore/QCoreApplication>
#include <QtCore/QSaveFile>
#include <QtGui/QAbstractTextDocumentLayout>
#include <QtGui/QPainter>
#include <QtGui/QPdfWriter>
#include <QtGui/QTextDocument>
#include <QtSvg/QSvgGenerator>

#include <qwt_plot.h>
#include <qwt_plot_renderer.h>

#include <cmath>
#include <memory>

namespace qplc {

namespace {

constexpr double pointsOfInch = 72.0;

std::unique_ptr<QTextDocument> documentOf(const QString &text, const QFont &font, int width)
{
    auto document = std::make_unique<QTextDocument>();
    document->setDefaultFont(font);
    document->setHtml(text);
    document->setTextWidth(width);
    return document;
}

}  // namespace

ChartPicture::ChartPicture(QwtPlot *plot, const QString &legend)
    : m_plot(plot)
    , m_legend(legend)
{
}

ChartPicture::~ChartPicture() = default;

int ChartPicture::legendHeight() const
{
    if (m_legend.isEmpty())
        return 0;
    return int(std::ceil(documentOf(m_legend, scaleFont(m_plot->font()), m_plot->width())->size().height()));
}

QSize ChartPicture::size() const
{
    return {m_plot->width(), m_plot->height() + legendHeight()};
}

void ChartPicture::paintPlot(QPainter *painter) const
{
    painter->fillRect(QRect(QPoint(), size()), m_plot->palette().window());
    QwtPlotRenderer renderer;
    renderer.setDiscardFlag(QwtPlotRenderer::DiscardBackground);
    renderer.setDiscardFlag(QwtPlotRenderer::DiscardCanvasBackground);
    renderer.render(m_plot, painter, QRectF(m_plot->contentsRect()));
}

void ChartPicture::paint(QPainter *painter) const
{
    paintPlot(painter);
    if (m_legend.isEmpty())
        return;
    painter->translate(0, m_plot->height());
    QAbstractTextDocumentLayout::PaintContext context;
    context.palette = m_plot->palette();
    documentOf(m_legend, scaleFont(m_plot->font()), m_plot->width())->documentLayout()->draw(painter, context);
}

QImage ChartPicture::image() const
{
    QImage image(size() * scale, QImage::Format_RGB32);
    image.setDevicePixelRatio(scale);
    QPainter painter(&image);
    paint(&painter);
    return image;
}

QByteArray ChartPicture::png() const
{
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    image().save(&buffer, "PNG");
    return buffer.data();
}

QByteArray ChartPicture::svg() const
{
    QBuffer buffer;
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setResolution(m_plot->logicalDpiX());
    generator.setSize(size());
    generator.setViewBox(QRect(QPoint(), size()));
    QPainter painter(&generator);
    paint(&painter);
    painter.end();
    return buffer.data();
}

/// A page that is as large as the picture.
QByteArray ChartPicture::pdf() const
{
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    QPdfWriter writer(&buffer);
    const int resolution = m_plot->logicalDpiX();
    writer.setResolution(resolution);
    writer.setPageSize(
        QPageSize(QSizeF(size()) * (pointsOfInch / resolution), QPageSize::Point, QString(), QPageSize::ExactMatch));
    writer.setPageMargins(QMarginsF());
    QPainter painter(&writer);
    paint(&painter);
    painter.end();
    return buffer.data();
}

QString ChartPicture::save(const QString &fileName) const
{
    const auto isOfKind
        = [&](const char *ending) { return fileName.endsWith(QLatin1String(ending), Qt::CaseInsensitive); };
    QSaveFile file(fileName);
    if (file.open(QIODevice::WriteOnly)) {
        const QByteArray content = isOfKind(".svg") ? svg() : isOfKind(".pdf") ? pdf() : png();
        if (file.write(content) == content.size() && file.commit())
            return {};
    }
    return QCoreApplication::translate("qplc::ChartPicture", "%1 cannot be written: %2. Choose another place.")
        .arg(fileName, file.errorString());
}

}  // namespace qplc

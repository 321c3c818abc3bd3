// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/CurveShape.h"
#include "gui/plot/PixelSpans.h"
#include "gui/plot/TimeColumns.h"
#include "gui/store/SignalStore.h"

#include <QtGui/QColor>
#include <QtGui/QPolygon>

#include <qwt_plot_item.h>

#include <limits>

namespace qplc {

/// A channel of a SignalStore as a curve of a plot.
///
/// The x axis is in seconds after origin(), the y axis in units of gain * value + offset. Each
/// column of device pixels shows all that happened in it, so that no spike is lost; NaN and
/// interruptions are gaps; values with a mark are drawn paler and thinner. What is drawn costs as
/// much as the plot is wide, whatever the number of rows. With RenderAntialiased, curves of few
/// rows are drawn smoothly; in vector pictures they are lines.
class StoreCurve : public QwtPlotItem
{
public:
    enum Style {
        Line,   // for reals
        Steps,  // for integers and booleans: a value holds until the next one
    };

    /// \param store  has to live as long as it is drawn; null: nothing is drawn
    StoreCurve(const SignalStore *store, int channel, const QString &title = QString());

    const SignalStore *store() const { return m_store; }
    int channel() const { return m_channel; }
    /// The time that is 0 on the x axis [ns].
    SignalStore::Time origin() const { return m_origin; }
    void setOrigin(SignalStore::Time origin);
    /// Shows only rows from \a begin to before \a end of their times [ns]
    void setLimits(SignalStore::Time begin, SignalStore::Time end);
    double gain() const { return m_gain; }
    double offset() const { return m_offset; }
    void setScaling(double gain, double offset);
    QColor color() const { return m_color; }
    void setColor(const QColor &color);
    /// In pixels of the screen as the user counts them, > 0; at least one device pixel is drawn.
    double lineWidth() const { return m_lineWidth; }
    void setLineWidth(double width);
    Qt::PenStyle penStyle() const { return m_penStyle; }
    /// Qt::SolidLine, or Qt::DashLine and Qt::DotLine, which move with the curve. \pre one of these
    void setPenStyle(Qt::PenStyle style);
    Style style() const { return m_style; }
    void setStyle(Style style);

    /// Smallest and largest value that is shown from \a begin to \a end of the x axis, with gain
    /// and offset.
    SignalStore::Range valueRange(double begin, double end) const;
    /// Columns of device pixels of an x axis. \param scale  device pixels of a pixel
    TimeColumns columns(const QwtScaleMap &xMap, double scale = 1.0) const;

    int rtti() const override { return Rtti_PlotUserItem + 1; }
    QwtGraphic legendIcon(int index, const QSizeF &size) const override;
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    class PixelScale;
    PixelSpans::Dashes dashes(const PixelScale &scale, const TimeColumns &columns) const;
    QPen penOf(const PixelScale &scale, bool isMarked) const;

    SignalStore::Time timeAt(double x) const;
    bool isDrawnAsLine(const QPainter &painter) const;
    void drawSpans(QPainter *painter, const PixelScale &scale, const PixelSpans::Dashes &dashes) const;
    void drawLines(QPainter *painter, const PixelScale &scale) const;
    void flushLine(QPainter *painter) const;
    void fill(QPainter *painter, PixelSpans *spans, const QColor &color) const;
    QColor colorOf(SignalStore::Mark mark) const;

    const SignalStore *m_store;
    int m_channel;
    SignalStore::Time m_origin = 0;
    SignalStore::Time m_begin = std::numeric_limits<SignalStore::Time>::min();
    SignalStore::Time m_end = std::numeric_limits<SignalStore::Time>::max();
    double m_gain = 1.0;
    double m_offset = 0.0;
    QColor m_color = Qt::black;
    double m_lineWidth = 1.0;
    Qt::PenStyle m_penStyle = Qt::SolidLine;
    Style m_style = Line;
    // Kept from picture to picture, so that drawing takes no memory.
    mutable CurveShape m_shape;
    mutable PixelSpans m_spans;
    mutable PixelSpans m_markedSpans;
    mutable QPolygon m_line;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PastRows.h"
#include "PathShape.h"
#include "gui/store/SignalStore.h"

#include <QtGui/QColor>

#include <qwt_plot_item.h>

#include <optional>

namespace qplc {

/// Two channels as a path, one over the other, for a piece of time; and the values of one moment as
/// a dot.
///
/// Pairs are rows of the same time of two channels of a plant. Interruptions are gaps, and rows of
/// which one value is NaN or stands in for that of a lost writer.
class XyCurve : public QwtPlotItem
{
public:
    using Time = QPlcPast::Time;

    XyCurve(const QPlcPast &x, const QPlcPast &y, const QString &title);

    const QPlcPast &x() const { return m_x; }
    const QPlcPast &y() const { return m_y; }
    void setColor(const QColor &color) { m_color = color; }
    QColor color() const { return m_color; }
    void setLineWidth(double width) { m_lineWidth = width; }
    /// The piece of time that is shown, \a end included.
    void setTimes(Time begin, Time end);
    /// The dot is at the values of \a time, without one at the newest. \param color  of the dot
    void setDot(std::optional<Time> time, const QColor &color);

    QPlcPast::Range xRange() const { return rangeOf(m_x); }
    QPlcPast::Range yRange() const { return rangeOf(m_y); }
    /// x and y at the dot; NaN where there is none.
    QPointF dot() const;
    /// Points of the path that was drawn last.
    std::size_t drawnPoints() const { return m_shape.pointCount(); }

    int rtti() const override { return Rtti_PlotUserItem + 2; }
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

private:
    QPlcPast::Range rangeOf(const QPlcPast &past) const;
    void readPath(const QwtScaleMap &xMap, const QwtScaleMap &yMap) const;

    QPlcPast m_x;
    QPlcPast m_y;
    QColor m_color = Qt::black;
    QColor m_dotColor = Qt::black;
    double m_lineWidth = 1.5;  // [px]
    Time m_begin = 0;
    Time m_end = 0;
    std::optional<Time> m_dotTime;
    mutable PathShape m_shape;
};

}  // namespace qplc

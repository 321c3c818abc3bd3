// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "JitterDistributions.h"

#include <QtGui/QColor>

#include <qwt_plot_item.h>

namespace qplc {

/// The bars of one histogram, side by side with one outline.
class JitterCurve : public QwtPlotItem
{
public:
    static constexpr double Microsecond = 1e3;  // [ns]

    explicit JitterCurve(const JitterDistribution &distribution);

    void setColor(const QColor &color) { m_color = color; }
    QColor color() const { return m_color; }

    int rtti() const override { return Rtti_PlotUserItem + 3; }
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

private:
    JitterDistribution m_distribution;
    QColor m_color = Qt::black;
};

/// Lines and texts at the median, the 99th percentile and the largest value of a distribution,
/// above all bars.
class JitterFigures : public QwtPlotItem
{
public:
    /// \param place  among all, 0 ...: texts of several stand below each other
    JitterFigures(const JitterDistribution &distribution, int place);

    void setColors(const QColor &color, const QColor &background);

    int rtti() const override { return Rtti_PlotUserItem + 4; }
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

private:
    void drawFigure(QPainter *painter, double x, int line, const QString &text, const QRectF &canvas) const;

    JitterDistribution m_distribution;
    int m_place;
    QColor m_color = Qt::black;
    QColor m_background = Qt::white;
};

}  // namespace qplc

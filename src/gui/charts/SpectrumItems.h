// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/Spectrum.h"

#include <QtCore/QVector>
#include <QtGui/QColor>
#include <QtGui/QPolygonF>

#include <qwt_plot_item.h>

#include <optional>

namespace qplc {

/// Lines of a spectrum as a curve: no peak is lost, however many lines a pixel has.
class SpectrumCurve : public QwtPlotItem
{
public:
    explicit SpectrumCurve(Spectrum::Lines lines);
    void setLook(const QColor &color, double width);
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

private:
    QPolygonF shape(const QwtScaleMap &xMap, const QwtScaleMap &yMap) const;

    Spectrum::Lines m_lines;
    QColor m_color;
    double m_width = 1.0;
};

/// A spectrogram: a pixel has the colour of the greatest density in it.
class SpectrogramItem : public QwtPlotItem
{
public:
    explicit SpectrogramItem(Spectrum::Picture picture);
    const Spectrum::Picture &picture() const { return m_picture; }
    /// The number of the column at a time [s], of the line at a frequency [Hz]; may be outside.
    double columnAt(double time) const;
    double lineAt(double frequency) const;
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

    struct Stop
    {
        double place;  // 0 to 1
        QColor color;
    };
    /// From low to high densities; lightness grows evenly.
    static const QVector<Stop> &colors();

private:
    struct Span
    {
        std::size_t begin;
        std::size_t end;  // begin: nothing is there
    };
    QVector<Span> spans(const QwtScaleMap &map, double begin, double pixels, double ratio, bool areLines) const;

    Spectrum::Picture m_picture;
};

/// A line at a frequency.
class SpectrumCursor : public QwtPlotItem
{
public:
    SpectrumCursor();
    void setLook(const QColor &color) { m_color = color; }
    void place(std::optional<double> frequency, bool isUpright);
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &canvas) const override;

private:
    QColor m_color;
    std::optional<double> m_frequency;
    bool m_isUpright = true;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FurtherAxis.h"
#include "PlotAxes.h"
#include "QPlcTheme.h"
#include "QPlcValueNames.h"
#include "TimeTicks.h"
#include "gui/models/SiPrefix.h"
#include "gui/plot/TimeColumns.h"

#include <QtCore/QHash>

#include <qwt_plot.h>
#include <qwt_plot_grid.h>

#include <memory>
#include <vector>

namespace qplc {

class TimeScaleDraw;
class ValueScaleDraw;

/// Axes and grid of a time plot. Knows times and pixels, but no signals.
///
/// The x axis is in seconds after origin(), the begin of the day: so that fractions of microseconds
/// are told apart.
class PlotCanvas : public QwtPlot
{
    Q_OBJECT
public:
    using Time = TimeTicks::Time;
    using Axis = int;  // of PlotAxes

    explicit PlotCanvas(QWidget *parent = nullptr);
    ~PlotCanvas() override;

    /// From now on there are these. Those that were there before are not made anew.
    void setAxes(const PlotAxes &axes);
    int axisCount() const { return int(m_axes.size()); }
    /// The scale beside the curves.
    QwtScaleWidget *scaleWidget(Axis axis) const;
    /// -1: it is no y axis.
    Axis axisOf(const QWidget *scale) const;
    /// Attaches an item whose values are those of an axis.
    void attach(QwtPlotItem *item, Axis axis);

    void setTheme(const QPlcTheme &theme);
    void setGridVisible(bool isVisible) { m_grid.setVisible(isVisible); }
    /// As the signal table has it; the axis shows it with the prefix that fits its values. \param
    /// colors of the curves of the axis; empty: it is the only one, whose colour says nothing
    void setUnit(Axis axis, const QString &unit, const QVector<QColor> &colors = {});
    /// Without numbers an axis keeps its room, so that canvases stay aligned.
    void setNumbersVisible(Axis axis, bool areVisible);
    /// What ticks are called; empty: numbers.
    void setNames(Axis axis, const QPlcValueNames &names);
    /// Small panels have little room at their sides: for short labels, and none for units.
    bool isCompact() const { return m_isCompact; }
    void setCompact(bool isCompact);
    /// A further axis is seen where the curves keep room enough.
    void setAxisVisible(Axis axis, bool isVisible);
    bool isAxisVisible(Axis axis) const;

    /// Device pixels that the canvas is wide, >= 1.
    int deviceWidth() const;
    /// What the time axis shows from the next replot() on. \param reference 0 of labels in seconds
    /// \param event 0 of labels around it, if there is one
    void setTime(const TimeColumns &columns, PlotSettings::Labels labels, Time reference,
                 std::optional<Time> event = std::nullopt);
    enum Ticks { AnyTicks, WholeTicks };
    /// \param lane  room below \a minimum [px], where no values are
    void setRange(Axis axis, double minimum, double maximum, Ticks ticks = AnyTicks, double lane = 0.0);

    Time origin() const { return m_origin; }
    /// Times of the left and the right edge.
    Time begin() const { return m_begin; }
    Time end() const { return m_end; }
    /// \param x  [px] from the left edge of the canvas
    Time timeAt(double x) const;
    double xOf(Time time) const;
    double valueAt(Axis axis, double y) const { return mapOf(axis).invTransform(y); }
    /// The largest value of an axis, without sign.
    double largest(Axis axis) const;
    double yOf(Axis axis, double value) const { return mapOf(axis).transform(value); }

    /// Draws the axes that QwtPlotRenderer does not know. \pre the origin is that of the plot
    void paintFurtherAxes(QPainter *painter) const;

    void updateLayout() override;
    void drawItems(QPainter *painter, const QRectF &canvasRect, const QwtScaleMap maps[axisCnt]) const override;

Q_SIGNALS:
    /// The canvas has another size.
    void resized();
    /// There is one more scale that hears the mouse.
    void scaleAdded(QWidget *scale);

protected:
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    struct ValueAxis
    {
        SiPrefix prefix;  // of the unit
        QVector<QColor> colors;
        QPlcValueNames names;
        bool hasNumbers = true;
        bool isVisible = true;
        QwtScaleDiv scale;
        std::unique_ptr<FurtherAxis> further;  // null: the plot has it
    };

    void renewScales();
    void renewScale(Axis axis);
    void applyNames(Axis axis);
    void showPrefix(Axis axis);
    void showUnit(Axis axis);
    void showColor(Axis axis);
    ValueScaleDraw *scaleDraw(Axis axis) const;
    QwtScaleMap mapOf(Axis axis) const;
    QwtScaleMap mapOf(Axis axis, QwtScaleMap ofLeft) const;
    void makeRoom();
    void placeFurtherAxes();

    QwtPlotGrid m_grid;
    TimeScaleDraw *m_timeScale = nullptr;  // of the x axis, which owns it
    std::vector<ValueAxis> m_axes;
    QHash<const QwtPlotItem *, Axis> m_axisOfItem;  // of further axes
    QColor m_mutedText;
    bool m_isCompact = false;
    Time m_origin = 0;
    Time m_begin = 0;
    Time m_end = 1'000'000'000;
};

}  // namespace qplc

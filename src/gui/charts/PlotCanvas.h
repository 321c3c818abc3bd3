// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotSettings.h"
#include "QPlcValueNames.h"
#include "TimeTicks.h"
#include "gui/panel/Theme.h"
#include "gui/plot/TimeColumns.h"

#include <qwt_plot.h>
#include <qwt_plot_grid.h>

namespace qplc {

class TimeScaleDraw;

/// Axes and grid of a time plot. Knows times and pixels, but no signals.
///
/// The x axis is in seconds after origin(), the begin of the day: so that fractions of microseconds are told apart.
class PlotCanvas : public QwtPlot
{
    Q_OBJECT
public:
    using Time = TimeTicks::Time;
    using Axis = PlotCurveSettings::Axis;

    explicit PlotCanvas(QWidget *parent = nullptr);

    static QwtPlot::Axis qwtAxis(Axis axis) { return axis == Axis::Left ? yLeft : yRight; }

    void setTheme(const Theme &theme);
    void setGridVisible(bool isVisible) { m_grid.setVisible(isVisible); }
    void setUnit(Axis axis, const QString &unit);
    /// Without numbers an axis keeps its room, so that canvases stay aligned.
    void setNumbersVisible(Axis axis, bool areVisible);
    /// What ticks are called; empty: numbers.
    void setNames(Axis axis, const QPlcValueNames &names);
    /// Small panels have little room at their sides: for short labels, and none for units.
    bool isCompact() const { return m_isCompact; }
    void setCompact(bool isCompact);
    void setAxisVisible(Axis axis, bool isVisible) { enableAxis(qwtAxis(axis), isVisible); }

    /// Device pixels that the canvas is wide, >= 1.
    int deviceWidth() const;
    /// What the time axis shows from the next replot() on. \param reference  0 of labels in seconds \param event  0 of labels around it, if there is one
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
    double valueAt(Axis axis, double y) const { return canvasMap(qwtAxis(axis)).invTransform(y); }
    double yOf(Axis axis, double value) const { return canvasMap(qwtAxis(axis)).transform(value); }

Q_SIGNALS:
    /// The canvas has another size.
    void resized();

protected:
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void renewScales();
    void applyNames(Axis axis);
    void showUnits();

    QwtPlotGrid m_grid;
    TimeScaleDraw *m_timeScale = nullptr;  // of the x axis, which owns it
    QString m_units[2];                    // of the y axes
    QPlcValueNames m_names[2];
    bool m_hasNumbers[2] = {true, true};
    bool m_isCompact = false;
    Time m_origin = 0;
    Time m_begin = 0;
    Time m_end = 1'000'000'000;
};

}  // namespace qplc

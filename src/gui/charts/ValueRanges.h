// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotAxes.h"
#include "PlotCanvas.h"
#include "StickyRange.h"

#include <QtCore/QElapsedTimer>

#include <vector>

namespace qplc {

class PlotCurves;

/// The ranges of the y axes of a time plot: by settings, by what is seen, or as a person has zoomed
/// them.
class ValueRanges
{
public:
    using Axis = PlotCanvas::Axis;

    /// \param canvas  shows the ranges; outlives this, as \a curves do
    ValueRanges(PlotCanvas *canvas, const PlotCurves *curves);

    /// Axes and curves are other ones. An axis that is another one than before has another range.
    void bind();
    /// What is seen next is taken as it is.
    void reset();
    /// What a person has zoomed follows the curves again.
    void release();
    /// Takes what is seen. \return whether a range is another one
    bool fit();
    void show(const PlotSettings &settings);
    /// \param about  [px] from the top of the canvas
    void zoom(Axis axis, double factor, double about);
    /// \param by  [px], > 0: to larger values
    void pan(Axis axis, double by);
    /// \param box  of the canvas, which then fills it [px]
    void zoomTo(const QRect &box);

private:
    struct Range
    {
        PlotAxes::Axis of{PlotCurveSettings::Left, {}};
        StickyRange automatic;
        bool isHeld = false;
        double minimum = 0.0;  // when held
        double maximum = 1.0;
    };

    Range &at(Axis axis) { return m_ranges[std::size_t(axis)]; }
    void show(Axis axis, const PlotRangeSettings &wanted);
    std::pair<double, double> seen(Axis axis) const;

    PlotCanvas *m_canvas;
    const PlotCurves *m_curves;
    std::vector<Range> m_ranges;
    QElapsedTimer m_clock;
};

}  // namespace qplc

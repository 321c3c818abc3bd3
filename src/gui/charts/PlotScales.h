// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcValueNames.h"
#include "TimeTicks.h"

#include <qwt_scale_draw.h>

#include <QtGui/QFontMetricsF>

namespace qplc {

/// An axis of values from \a minimum to \a maximum with ticks at round numbers: as many labels as
/// have room, three where they do not touch, and two at least, whatever the range and the room.
/// \param room along the axis [px] \param label that a label takes of it [px] \param step between
///         ticks at least; 1 for whole numbers
QwtScaleDiv valueScale(double minimum, double maximum, double room, double label, double step = 0.0);

/// Labels of an axis of values: as many digits as the step needs, and room that does not depend on
/// them, so that canvases neither jump nor differ from plot to plot.
class ValueScaleDraw : public QwtScaleDraw
{
public:
    /// \param characters  that there is always room for beside a y axis
    ValueScaleDraw(const QFont &font, int characters);
    /// What ticks are called, shortened to the usual room; empty: numbers.
    void setNames(const QPlcValueNames &names);
    /// Numbers are values times this: of a unit with a prefix.
    void setFactor(double factor);
    QwtText label(double value) const override;

private:
    QFontMetricsF m_metrics;
    double m_room;  // of a label [px]
    double m_factor = 1.0;
    QPlcValueNames m_names;
};

/// Labels of a time axis. What would reach over the edge is left out, for the canvas would become
/// narrower.
class TimeScaleDraw : public QwtScaleDraw
{
public:
    /// \param isCompact  no room beside the canvas: labels there are left out
    TimeScaleDraw(const QFont &font, bool isCompact);

    using Time = TimeTicks::Time;
    /// \param origin  the time that is 0 on the axis
    void setTicks(const TimeTicks &ticks, Time origin);
    /// Room to both sides of the canvas [px]
    int sideRoom() const;
    /// Of the widest label that is usual [px]
    double usualWidth() const;

    QwtText label(double value) const override;

private:
    QFontMetricsF m_metrics;
    bool m_isCompact;
    TimeTicks m_ticks{0, 1, 1};
    Time m_origin = 0;
};

}  // namespace qplc

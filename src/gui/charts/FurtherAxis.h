// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotSettings.h"

#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>

namespace qplc {

/// A y axis beside those that a QwtPlot has.
class FurtherAxis : public QwtScaleWidget
{
    Q_OBJECT
public:
    FurtherAxis(PlotCurveSettings::Axis side, QWidget *plot);

    PlotCurveSettings::Axis side() const { return m_side; }
    /// That it needs beside a canvas of this height [px]
    int widthFor(int height) const;
    /// Stands at \a x, so that its scale is from \a top to \a bottom [px of the plot].
    void place(int x, double top, double bottom);
    using QwtScaleWidget::draw;

private:
    PlotCurveSettings::Axis m_side;
};

}  // namespace qplc

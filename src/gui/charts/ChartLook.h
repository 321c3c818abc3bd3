// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/Theme.h"

class QwtPlot;
class QwtPlotGrid;
class QwtPlotLegendItem;

namespace qplc {

/// Gives a plot the look of the panels: no frames, a quiet grid, small muted numbers. \param grid, legend  of the plot; null: it has none
void applyLook(QwtPlot *plot, QwtPlotGrid *grid, QwtPlotLegendItem *legend, const Theme &theme);
/// The title of an axis in the colours of the panels; empty: none.
void setAxisText(QwtPlot *plot, int axis, const QString &text, const Theme &theme);
/// "power [W]", "power", "[W]".
QString withUnit(const QString &name, const QString &unit);

}  // namespace qplc

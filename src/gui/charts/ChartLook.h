// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"

#include <QtCore/QVector>
#include <QtGui/QFont>

class QwtPlot;
class QwtPlotGrid;

namespace qplc {

/// [px] Plots and panels that are lower have no titles, captions and legends.
constexpr int leastHeightOfTexts = 150;

/// Gives a plot the look of the panels: no frames, a quiet grid, small muted numbers. \param grid
/// of the plot
void applyLook(QwtPlot *plot, QwtPlotGrid *grid, const QPlcTheme &theme);
/// Of the numbers and titles of axes: smaller than that of the window.
QFont scaleFont(const QFont &font);
/// Of the other texts in plots and beside them: a little smaller than that of the window.
QFont smallFont(const QFont &font);
/// As many numbers at the axes as have room. To be called when the plot has another size.
void fitAxes(QwtPlot *plot);
/// The title of an axis in the colours of the panels; empty: none, nor in a plot that is too small
/// for titles.
void setAxisText(QwtPlot *plot, int axis, const QString &text, const QPlcTheme &theme);
struct LegendEntry
{
    QString title;
    QColor color;
};
/// A coloured square and a title for each, as rich text that may be wrapped; empty for less than
/// two: then axes and captions say it.
QString legendText(const QVector<LegendEntry> &entries);
/// "power [W]", "power", "[W]".
QString withUnit(const QString &name, const QString &unit);

}  // namespace qplc

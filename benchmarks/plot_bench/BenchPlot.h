// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotBenchOptions.h"
#include "gui/plot/RedrawRule.h"
#include "gui/plot/StoreCurve.h"

#include <qwt_plot.h>

#include <vector>

/// A live time plot with axes and a grid.
class BenchPlot : public QwtPlot
{
public:
    /// \param firstChannel  of \a store, the one of the first curve
    BenchPlot(const qplc::SignalStore &store, int firstChannel, const PlotBenchOptions &options);

    /// Moves on to the newest rows. \return whether the plot is drawn anew
    bool showNewest();

private:
    const qplc::SignalStore &m_store;
    bool m_drawsEveryFrame;
    qplc::SignalStore::Time m_span;  // [ns]
    std::vector<qplc::StoreCurve *> m_curves;
    qplc::RedrawRule m_redraw;
};

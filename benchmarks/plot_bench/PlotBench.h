// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BenchPlot.h"
#include "BenchSource.h"
#include "PlotBenchOptions.h"

#include <QtCore/QJsonObject>
#include <QtWidgets/QWidget>

#include <vector>

/// A window of live plots, drawn for a while.
class PlotBench
{
public:
    explicit PlotBench(const PlotBenchOptions &options);

    void run();
    /// The figures of run().
    QJsonObject result() const;
    /// \return false when the picture cannot be written
    bool savePicture();

private:
    void layOut();
    void drawFrame();

    PlotBenchOptions m_options;
    double m_residentBefore;  // [bytes]
    qplc::SignalStore m_store;
    BenchSource m_source;
    QWidget m_window;
    std::vector<BenchPlot *> m_plots;
    double m_residentOfStore = 0.0;  // [bytes]
    double m_appendTime = 0.0;       // [s] for one value
    double m_processorTime = 0.0;    // [s]
    int m_drawnPlots = 0;
    std::vector<double> m_frames;  // [s] for each
};

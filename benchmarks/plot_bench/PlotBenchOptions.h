// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

class QCoreApplication;

/// The command line of qtplc_plot_bench.
struct PlotBenchOptions
{
    int plots = 8;
    int curves = 4;        // of each plot
    int points = 1000000;  // of each curve, all of them in view
    int fps = 50;
    double seconds = 5.0;
    bool drawsEveryFrame = true;
    int channels = 32;       // of the store, plots * curves at least
    double lineWidth = 1.0;  // [px]
    double noise = 0.1;      // amplitude; the axes go from -2 to 2
    QString picture;         // file for a picture of the window at the end, empty: none

    /// Rows of the store: some more than are in view, as in a window that shows a part of the past.
    int rows() const { return points + points / 64 + 16; }

    /// \return false when the program is to end now with \a exitCode, all messages being out
    static bool read(const QCoreApplication &application, PlotBenchOptions *options, int *exitCode);
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Recording.h"

#include <functional>

namespace qplc {

/// Curves of a plot: extremes of equal intervals, from \a begin to \a end [s].
struct ReportPlot
{
    QString title;
    double begin = 0.0;
    double end = 1.0;
    std::vector<std::vector<overview::Bucket>> curves;
    QStringList names;  // of the curves, if there are several
};

/// A drawing (SVG) with axes, as wide as its place.
QByteArray drawingOf(const ReportPlot &plot);

/// States over time: extremes of equal intervals, from \a begin to \a end [s].
struct ReportStates
{
    QString title;
    double begin = 0.0;
    double end = 1.0;
    std::vector<overview::Bucket> intervals;
    std::function<QString(double state)> nameOf;
};

/// A strip (SVG) whose pieces are the states, with their names where there is room. Intervals with
/// several states are grey.
QByteArray drawingOf(const ReportStates &states);

/// Cycles by their lateness: counts of ranges whose borders grow by a constant factor.
struct LatenessHistogram
{
    static constexpr int RangesOfADecade = 5;
    static constexpr int Ranges = 8 * RangesOfADecade;  // 100 ns to 10 s

    void add(std::int64_t lateness, std::uint64_t cycles = 1);
    /// \param part  0 to 1. \return the lateness [ns] that so many cycles do not exceed
    std::int64_t quantile(double part) const;
    static double border(int range);  // [ns], the lower one

    std::uint64_t counts[Ranges] = {};
    std::uint64_t count = 0;
    std::int64_t most = 0;
};
QByteArray drawingOf(const LatenessHistogram &histogram);

/// "1.5", with at most five digits
QString shortNumber(double number);
/// "12.5 us"
QString shortDuration(double seconds);

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotAxes.h"
#include "PlotRuns.h"
#include "QPlcPast.h"
#include "QPlcTheme.h"
#include "StateBands.h"
#include "gui/plot/CursorStatistics.h"
#include "gui/plot/RunDifference.h"
#include "gui/plot/StoreCurve.h"

#include <memory>
#include <utility>
#include <vector>

class QPlcPanelContext;
class QwtPlotMarker;

namespace qplc {

class PlotCanvas;

/// A curve of a plot as it is at the moment: what is wanted, and where it comes from.
struct PlotCurve
{
    PlotCurveSettings settings;
    QPlcPast source;  // held as long as the item draws it
    QColor color;
    Qt::PenStyle penStyle = Qt::SolidLine;
    int axis = 0;                       // of PlotAxes
    std::unique_ptr<StoreCurve> item;   // of a line
    std::unique_ptr<StateBands> bands;  // of what is drawn as bands
    std::vector<std::unique_ptr<QwtPlotMarker>> limits;
    PlotRun run;                                // of the plot; without runs, what its own plant has
    bool isFurther = false;                     // lies over the curve of the settings
    bool isReplaced = false;                    // by differences
    std::unique_ptr<RunDifference> difference;  // what the source has
    std::vector<QPlcPast> runPasts;             // that the difference reads

    PlotCurve();
    PlotCurve(PlotCurve &&) noexcept;
    ~PlotCurve();

    bool isMissing() const { return !source; }
    bool isSeen() const { return settings.isVisible && !isReplaced && !isMissing(); }
    /// Whether it is a line, with values on an axis.
    bool isLine() const { return isSeen() && !isDrawnAsBands(); }
    bool canBeBands() const { return source.isStepped && !settings.isScaled() && !isFurther; }
    bool isDrawnAsBands() const { return settings.isBands && canBeBands(); }
    /// Of the values that are drawn; empty: none.
    QPlcValueNames names() const { return settings.isScaled() ? QPlcValueNames() : source.names; }
    bool isStale() const { return source && run.isWhole() && !difference && !source.isCurrent(); }
    /// What legends and tables call it: "power · flight2".
    QString text() const;
    /// The piece of its run that is in \a begin to \a end of the plot, in times of the run; in any
    /// order. Nothing of it: first > second
    std::pair<QPlcPast::Time, QPlcPast::Time> ownTimes(QPlcPast::Time begin, QPlcPast::Time end) const;
    CursorStatistics::Scaling scaling() const { return {settings.gain, settings.offset, source.isStepped}; }
    /// At \a time, the newest one without; NaN: none.
    double value(std::optional<QPlcPast::Time> time) const;
    /// What legends and tables have beside its name: for bands, the colour of the state that has \a
    /// value.
    QColor swatchColor(double value) const;
    /// Of the value at \a time; without, the worst one of the last moments.
    QPlcQuality::Kind mark(std::optional<QPlcPast::Time> time) const;
};

/// The curves of a plot, which draws them.
class PlotCurves
{
public:
    explicit PlotCurves(PlotCanvas *plot);
    ~PlotCurves();

    /// Finds all signals anew.
    /// \param runs  that lie over each other; the first one is that of the curves
    void bind(const PlotSettings &settings, const QPlcPanelContext &context, const std::vector<PlotRun> &runs = {});

    int size() const { return int(m_curves.size()); }
    bool isEmpty() const { return m_curves.empty(); }
    /// Whether runs lie over each other.
    bool hasRuns() const;
    /// Calculates some more rows of differences.
    void advanceDifferences();
    /// Whether differences are only those of the newest rows.
    bool areDifferencesCut() const;
    /// Changes when a run that lies over the curves goes on.
    QPlcPast::Row endOfFurtherRows() const;
    const PlotCurve &at(int place) const { return m_curves[std::size_t(place)]; }
    std::vector<PlotCurve>::const_iterator begin() const { return m_curves.begin(); }
    std::vector<PlotCurve>::const_iterator end() const { return m_curves.end(); }

    /// The bold one; -1: none.
    int selected() const { return m_selected; }
    void select(int place, const QPlcTheme &theme);
    void setOrigin(QPlcPast::Time origin);
    /// Of the curves that are seen: one for each that have the same rows.
    const std::vector<QPlcPast> &pasts() const { return m_pasts; }
    const PlotAxes &axes() const { return m_axes; }
    /// Whether curves that are not hidden have this axis.
    bool hasAxis(int axis) const;
    /// The largest value that an axis shows, without sign.
    double largest(int axis) const;
    /// How many axes have curves that are not hidden.
    int seenAxes() const;
    /// Of the lines of an axis that are seen.
    QVector<QColor> colors(int axis) const;
    bool hasBands() const;
    /// Of bands below lines, which leave it free [px]
    double laneHeight() const;
    /// Whether an axis has curves, and all of them are whole numbers.
    bool isWhole(int axis) const;
    /// Of the values of all lines of an axis; empty when they differ.
    QPlcValueNames names(int axis) const;
    /// Smallest and largest value of all seen curves of an axis, and of its lines.
    QPlcPast::Range range(int axis, double begin, double end) const;
    /// Of the newest row of the plants whose signals are seen; 0 without a row. A derived signal
    /// may still lack it.
    QPlcPast::Time newestTime() const;
    /// Times of the first and the last row; false: there are none.
    bool timeRange(QPlcPast::Time *begin, QPlcPast::Time *end) const;

private:
    void addFurther(const QPlcPanelContext &context, const std::vector<PlotRun> &runs);
    void makeDifferences(std::size_t bases);
    void show(PlotCurve *curve, bool showsLimits, const QPlcTheme &theme);
    void showBands(PlotCurve *curve, const QPlcTheme &theme);
    void placeBands();
    void showLimit(PlotCurve *curve, double limit);
    void showLines(int axis, const QVector<double> &lines, const QPlcTheme &theme);

    PlotCanvas *m_plot;
    PlotAxes m_axes;
    std::vector<PlotCurve> m_curves;
    std::vector<QPlcPast> m_pasts;
    std::vector<std::unique_ptr<QwtPlotMarker>> m_lines;  // for reference
    std::vector<QVector<double>> m_lineValues;            // of the y axes
    QPlcPast::Time m_origin = 0;
    int m_selected = -1;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPast.h"
#include "RunSettings.h"
#include "gui/plot/RisingEdges.h"

#include <QtCore/QPersistentModelIndex>

#include <limits>
#include <optional>
#include <vector>

class QPlcPanelContext;

namespace qplc {

struct PlotSettings;

/// The past of \a expression, a curve of the plant \a reference, in another plant. What names its
/// plant within a formula has none there.
QPlcPast plantPast(const QPlcPanelContext &context, const QString &expression, const QString &reference,
                   const QString &plant);

/// A run that lies over the curves of a plot, or that is under all others: a piece of the past of a
/// plant, moved in time.
struct PlotRun
{
    using Time = QPlcPast::Time;

    QString plant;                                  // empty: that of each curve
    QString name;                                   // for people
    Time shift = 0;                                 // from its times to those of the plot [ns]
    Time begin = std::numeric_limits<Time>::min();  // of what is shown, in its times [ns]
    Time end = std::numeric_limits<Time>::max();    // first time that is not shown

    bool contains(Time own) const { return begin <= own && own < end; }
    bool isWhole() const { return end == std::numeric_limits<Time>::max(); }
};

/// The runs of a plot: finds which there are, and where they lie.
///
/// The first one is the reference: its times are those of the plot. With pieces, it is the newest
/// one of the plant of the curves.
class PlotRuns
{
public:
    using Time = QPlcPast::Time;

    /// Finds everything anew.
    void bind(const PlotSettings &settings, const QPlcPanelContext &context);
    /// Looks at new values and events. \return whether all() are others
    bool update(const QPlcPanelContext &context);
    /// Texts of the events of a plant, each once, the newest first.
    static QStringList eventTexts(const QPlcPanelContext &context, const QString &plant);

    /// Empty: the plot shows no runs, or problem() says why it cannot.
    const std::vector<PlotRun> &all() const { return m_runs; }
    /// The time of the plot that is 0 for each run; none: times are those of the clock.
    std::optional<Time> zero() const { return m_zero; }
    /// From zero() to the end of the longest run [ns]
    Time length() const;
    /// What is wrong, as a sentence for people; empty: nothing.
    QString problem() const { return m_problem; }
    /// The plant of the curves; empty: none is there.
    QString reference() const { return m_reference; }

private:
    struct Source
    {
        QString plant;
        QPlcPast past;
        std::optional<RisingEdges> edges;
        std::deque<Time> begins;  // of its pieces, oldest first
    };

    void alignBegins(const PlotSettings &settings, const QPlcPanelContext &context);
    QPlcPast firstPast(const PlotSettings &settings, const QPlcPanelContext &context, const QString &plant) const;
    void findPieces(const PlotSettings &settings, const QPlcPanelContext &context);
    bool findBegins(Source *source, const QPlcPanelContext &context) const;
    std::deque<Time> eventsOf(const Source &source, const QPlcPanelContext &context) const;
    std::deque<Time> pausesOf(const Source &source) const;
    QString problemOf(const Source &reference) const;
    void alignPieces();
    void addPieces(const Source &source, Time zero, bool isReference);

    RunSettings m_settings;
    QString m_reference;  // the plant of the curves
    std::vector<Source> m_sources;
    std::vector<PlotRun> m_runs;
    std::optional<Time> m_zero;
    QString m_problem;
    QPersistentModelIndex m_newestEvent;  // that was looked at
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "PlotRuns.h"

#include "PlotSettings.h"
#include "QPlcPanelContext.h"
#include "QPlcTimePlot.h"
#include "TimeTicks.h"
#include "gui/models/ValueFormat.h"
#include "gui/plot/PastRows.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr PlotRuns::Time aSecond = 1'000'000'000;  // [ns]
constexpr PlotRuns::Time aMillisecond = 1'000'000;

/// The plant whose times the plot has: that of the first curve that is there.
QString referenceOf(const PlotSettings &settings, const QPlcPanelContext &context)
{
    for (const PlotCurveSettings &curve : settings.curves) {
        if (const QPlcPast past = context.past(curve.signal))
            return past.plant;
    }
    return {};
}

}  // namespace

void PlotRuns::bind(const PlotSettings &settings, const QPlcPanelContext &context)
{
    const std::vector<Source> before = std::move(m_sources);  // derived signals that go on are not made anew
    *this = PlotRuns();
    m_settings = settings.runs;
    if (!m_settings.isOn || settings.curves.isEmpty())
        return;
    m_reference = referenceOf(settings, context);
    m_settings.plants.removeAll(m_reference);
    if (m_settings.hasEdges())
        findEdges(context);
    else if (m_settings.plants.isEmpty())
        m_problem = QPlcTimePlot::tr("Choose a run to lie over this one.");
    else
        alignBegins(settings, context);
}

/// Runs whose curves are all missing stay at their own times.
void PlotRuns::alignBegins(const PlotSettings &settings, const QPlcPanelContext &context)
{
    const auto beginOf = [&](const QString &plant) -> std::optional<Time> {
        for (const PlotCurveSettings &curve : settings.curves) {
            const QPlcPast past = plantPast(context, curve.signal, m_reference, plant);
            if (past && !past.isEmpty())
                return past.time(past.firstRow());
        }
        return std::nullopt;
    };
    const std::optional<Time> zero = beginOf(m_reference);
    PlotRun reference;
    reference.name = m_reference;
    m_runs.push_back(reference);
    for (const QString &plant : qAsConst(m_settings.plants)) {
        PlotRun run;
        run.plant = plant;
        run.name = plant;
        const std::optional<Time> begin = beginOf(plant);
        if (m_settings.alignment == RunSettings::Begins && zero && begin)
            run.shift = *zero - *begin;
        m_runs.push_back(run);
    }
}

void PlotRuns::findEdges(const QPlcPanelContext &context)
{
    for (const QString &plant : QStringList{m_reference} + m_settings.plants) {
        Source source;
        source.plant = plant;
        source.past = plantPast(context, m_settings.signal, m_reference, plant);
        if (const PastRows rows = PastRows::of(source.past); rows.store) {
            const Time apart = std::llround(std::min(m_settings.apart, 1e6) * double(aSecond));
            source.edges.emplace(rows.store, rows.channel, m_settings.level, m_settings.last, apart);
            source.edges->update();
        }
        m_sources.push_back(std::move(source));
    }
    alignEdges();
}

bool PlotRuns::update()
{
    bool isOther = false;
    for (Source &source : m_sources)
        isOther = (source.edges && source.edges->update()) || isOther;
    if (isOther)
        alignEdges();
    return isOther;
}

void PlotRuns::alignEdges()
{
    m_runs.clear();
    m_zero.reset();
    m_problem.clear();
    const Source &reference = m_sources.front();
    if (m_settings.signal.isEmpty()) {
        m_problem = QPlcTimePlot::tr("Choose the signal whose edges begin a run.");
    } else if (!reference.edges) {
        m_problem = reference.past.problem;
    } else if (reference.edges->times().empty()) {
        m_problem = QPlcTimePlot::tr("%1 does not rise to %2 in the values that are here.")
                        .arg(QPlcPast::textOf(m_settings.signal), numberText(m_settings.level));
    } else {
        m_zero = reference.edges->times().back();
        for (const Source &source : m_sources)
            addLaps(source, *m_zero, &source == &reference);
    }
}

/// The newest one first; each ends where the next one begins.
void PlotRuns::addLaps(const Source &source, Time zero, bool isReference)
{
    if (!source.edges)
        return;
    const std::deque<RisingEdges::Time> &times = source.edges->times();
    Time shortest = aSecond;
    for (std::size_t i = 1; i < times.size(); ++i)
        shortest = std::min<Time>(shortest, times[i] - times[i - 1]);
    for (std::size_t i = times.size(); i-- > 0;) {
        PlotRun run;
        run.plant = isReference ? QString() : source.plant;
        run.name = TimeTicks::clockText(times[i], shortest < aSecond ? aMillisecond : aSecond);
        if (m_sources.size() > 1)
            run.name.prepend(source.plant + QLatin1Char(' '));
        run.shift = zero - times[i];
        const bool isNewest = i + 1 == times.size();
        if (!isNewest)
            run.end = times[i + 1];
        if (!isNewest || !isReference)
            run.begin = times[i];
        m_runs.push_back(run);
    }
}

PlotRuns::Time PlotRuns::length() const
{
    Time longest = 0;
    for (const PlotRun &run : m_runs) {
        if (!run.isWhole() && m_zero)
            longest = std::max(longest, run.end + run.shift - *m_zero);
    }
    for (const Source &source : m_sources) {  // the newest one goes on
        if (source.edges && !source.edges->times().empty())
            longest = std::max(longest, source.past.newestTime() - source.edges->times().back());
    }
    return longest;
}

QPlcPast plantPast(const QPlcPanelContext &context, const QString &expression, const QString &reference,
                   const QString &plant)
{
    if (plant == reference)
        return context.past(expression);
    if (QPlcPast::textOf(expression) != expression) {
        QPlcPast none;
        none.expression = expression;
        none.problem = QPlcTimePlot::tr("A formula is compared within its own run. Remedy: compare its signals.");
        return none;
    }
    const QString prefix = reference + QLatin1Char('/');  // signals of some layouts name their plant
    const QString signal = expression.startsWith(prefix) ? expression.mid(prefix.size()) : expression;
    return context.past(plant + QLatin1Char('/') + signal);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "PlotRuns.h"

#include "PlotSettings.h"
#include "QPlcPanelContext.h"
#include "QPlcTimePlot.h"
#include "TimeTicks.h"
#include "gui/models/EventLogModel.h"
#include "gui/models/ValueFormat.h"
#include "gui/plot/PastRows.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr PlotRuns::Time aSecond = 1'000'000'000;  // [ns]
constexpr PlotRuns::Time leastPause = aSecond;
constexpr int mostEventTexts = 50;  // of events, to choose from
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

QString textOfEvent(const QAbstractItemModel &events, int row)
{
    return events.index(row, EventLogModel::Text).data().toString();
}

bool isEventOf(const QAbstractItemModel &events, int row, const QString &plant)
{
    const QString source = events.index(row, EventLogModel::Source).data().toString();
    return source == plant || source.startsWith(plant + QLatin1Char('/'));
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
    if (m_settings.hasPieces())
        findPieces(settings, context);
    else if (m_settings.plants.isEmpty())
        m_problem = QPlcTimePlot::tr("Choose a run to lie over this one.");
    else
        alignBegins(settings, context);
}

/// Of the first curve that a plant has.
QPlcPast PlotRuns::firstPast(const PlotSettings &settings, const QPlcPanelContext &context, const QString &plant) const
{
    for (const PlotCurveSettings &curve : settings.curves) {
        const QPlcPast past = plantPast(context, curve.signal, m_reference, plant);
        if (past && !past.isEmpty())
            return past;
    }
    return {};
}

/// Runs whose curves are all missing stay at their own times.
void PlotRuns::alignBegins(const PlotSettings &settings, const QPlcPanelContext &context)
{
    const auto beginOf = [&](const QString &plant) -> std::optional<Time> {
        const QPlcPast past = firstPast(settings, context, plant);
        return past ? std::optional<Time>(past.time(past.firstRow())) : std::nullopt;
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

void PlotRuns::findPieces(const PlotSettings &settings, const QPlcPanelContext &context)
{
    const bool hasEdges = m_settings.alignment == RunSettings::RisingEdges;
    for (const QString &plant : QStringList{m_reference} + m_settings.plants) {
        Source source;
        source.plant = plant;
        source.past = hasEdges ? plantPast(context, m_settings.signal, m_reference, plant)
                               : firstPast(settings, context, plant);
        if (const PastRows rows = PastRows::of(source.past); rows.store && hasEdges) {
            const Time apart = std::llround(std::min(m_settings.apart, 1e6) * double(aSecond));
            source.edges.emplace(rows.store, rows.channel, m_settings.level, m_settings.last, apart);
        }
        m_sources.push_back(std::move(source));
    }
    update(context);
    alignPieces();
}

bool PlotRuns::update(const QPlcPanelContext &context)
{
    bool isOther = false;
    for (Source &source : m_sources)
        isOther = findBegins(&source, context) || isOther;
    if (const QAbstractItemModel *events = context.eventModel())
        m_newestEvent = events->index(events->rowCount() - 1, 0);
    if (isOther)
        alignPieces();
    return isOther;
}

/// \return whether they are others. Events are looked for when there are new ones
bool PlotRuns::findBegins(Source *source, const QPlcPanelContext &context) const
{
    if (!source->past)
        return false;
    std::deque<Time> begins = source->begins;
    if (source->edges) {
        source->edges->update();
        begins.assign(source->edges->times().begin(), source->edges->times().end());
    } else if (m_settings.alignment == RunSettings::Pauses) {
        begins = pausesOf(*source);
    } else if (const QAbstractItemModel *events = context.eventModel()) {
        if (!m_newestEvent.isValid() || m_newestEvent.row() + 1 != events->rowCount())
            begins = eventsOf(*source, context);
    }
    while (!begins.empty() && (source->past.isEmpty() || begins.front() < source->past.time(source->past.firstRow())))
        begins.pop_front();
    const bool isOther = begins != source->begins;
    source->begins = std::move(begins);
    return isOther;
}

/// The first cycles at or after the events. For an event behind all cycles, its own time.
std::deque<PlotRuns::Time> PlotRuns::eventsOf(const Source &source, const QPlcPanelContext &context) const
{
    std::deque<Time> begins;
    const QAbstractItemModel *events = context.eventModel();
    const QPlcPast &past = source.past;
    for (int row = events->rowCount(); row-- > 0 && int(begins.size()) < m_settings.last;) {
        if (!isEventOf(*events, row, source.plant) || textOfEvent(*events, row) != m_settings.event)
            continue;
        const Time time = events->index(row, 0).data(QPlcPanelContext::EventTimeRole).toLongLong() * aMillisecond;
        if (past.isEmpty() || time < past.time(past.firstRow()))
            continue;
        const QPlcPast::Row first = past.rowAt(time);
        const Time begin = first < past.endRow() ? past.time(first) : time;
        if (begins.empty() || begin < begins.front())
            begins.push_front(begin);
    }
    return begins;
}

/// The first cycle that is kept, and those behind a second or more without any.
std::deque<PlotRuns::Time> PlotRuns::pausesOf(const Source &source) const
{
    std::deque<Time> begins;
    const QPlcPast &past = source.past;
    if (past.isEmpty())
        return begins;
    const SignalStore &store = *PastRows::of(past).store;
    begins.push_back(past.time(past.firstRow()));
    for (QPlcPast::Row row = store.nextBeginAnew(past.firstRow() + 1, past.endRow()); row < past.endRow();
         row = store.nextBeginAnew(row + 1, past.endRow())) {
        if (past.time(row) - past.time(row - 1) < leastPause)
            continue;
        begins.push_back(past.time(row));
        if (int(begins.size()) > m_settings.last)
            begins.pop_front();
    }
    return begins;
}

QString PlotRuns::problemOf(const Source &reference) const
{
    const bool hasEdges = m_settings.alignment == RunSettings::RisingEdges;
    if (hasEdges && m_settings.signal.isEmpty())
        return QPlcTimePlot::tr("Choose the signal whose edges begin a run.");
    if (m_settings.alignment == RunSettings::Events && m_settings.event.isEmpty())
        return QPlcTimePlot::tr("Choose the event that begins a run.");
    if (!reference.past)
        return reference.past.problem.isEmpty() ? QPlcTimePlot::tr("There are no values.") : reference.past.problem;
    if (!reference.begins.empty())
        return {};
    return hasEdges ? QPlcTimePlot::tr("%1 does not rise to %2 in the values that are here.")
                          .arg(QPlcPast::textOf(m_settings.signal), numberText(m_settings.level))
                    : QPlcTimePlot::tr("There is no such event in the values that are here.");
}

void PlotRuns::alignPieces()
{
    m_runs.clear();
    m_zero.reset();
    const Source &reference = m_sources.front();
    m_problem = problemOf(reference);
    if (!m_problem.isEmpty())
        return;
    m_zero = reference.begins.back();
    for (const Source &source : m_sources)
        addPieces(source, *m_zero, &source == &reference);
}

/// The newest one first; each ends where the next one begins.
void PlotRuns::addPieces(const Source &source, Time zero, bool isReference)
{
    const std::deque<Time> &times = source.begins;
    Time shortest = aSecond;
    for (std::size_t i = 1; i < times.size(); ++i)
        shortest = std::min(shortest, times[i] - times[i - 1]);
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
    for (const Source &source : m_sources) {
        const std::deque<Time> &begins = source.begins;
        for (std::size_t i = 0; i < begins.size(); ++i) {
            const QPlcPast::Row end = i + 1 < begins.size() ? source.past.rowAt(begins[i + 1]) : source.past.endRow();
            if (end > source.past.firstRow())
                longest = std::max(longest, source.past.time(end - 1) - begins[i]);
        }
    }
    return longest;
}

QStringList PlotRuns::eventTexts(const QPlcPanelContext &context, const QString &plant)
{
    QStringList texts;
    const QAbstractItemModel *events = context.eventModel();
    for (int row = events ? events->rowCount() : 0; row-- > 0 && texts.size() < mostEventTexts;) {
        if (!isEventOf(*events, row, plant))
            continue;
        const QString text = textOfEvent(*events, row);
        if (!texts.contains(text))
            texts << text;
    }
    return texts;
}

QPlcPast plantPast(const QPlcPanelContext &context, const QString &expression, const QString &reference,
                   const QString &plant)
{
    if (plant == reference)
        return context.past(expression);
    const QString prefix = reference + QLatin1Char('/');  // signals of some layouts name their plant
    QPlcPast past = context.past(expression.startsWith(prefix) ? expression.mid(prefix.size()) : expression, plant);
    if (past && past.plant != plant) {
        QPlcPast none;
        none.expression = expression;
        none.problem = QPlcTimePlot::tr("%1 names its plant. Remedy: leave the plant out of the names.")
                           .arg(QPlcPast::textOf(expression));
        return none;
    }
    return past;
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "RecordingReport.h"

#include "Happenings.h"
#include "RecordedRoster.h"
#include "RecordingMessages.h"
#include "ReportDrawing.h"
#include "ReportFormula.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace qplc {

namespace {

constexpr int Intervals = 700;  // of a plot
constexpr int UsualPlots = 12;  // where nobody has chosen
constexpr int MostCurves = 6;   // of a plot: elements of an array
constexpr int MostHappenings = 200;
constexpr int MostFormulas = 100;

const char style[]
    = ":root{--back:#fff;--text:#1b1f24;--soft:#5c6670;--line:#d8dee4;--tile:#f4f6f8;--bad:#b42318;"
      "--c0:#0b62b0;--c1:#c2570c;--c2:#1a7f37;--c3:#8250df;--c4:#bf2c72;--c5:#6b6f76}"
      "@media screen and (prefers-color-scheme:dark){:root{--back:#14181d;--text:#e6eaee;--soft:#9aa5b1;--line:#333c46;"
      "--tile:#1d232a;--bad:#ff8a80;--c0:#6cb2ff;--c1:#ffa657;--c2:#56d364;--c3:#bc8cff;--c4:#ff7eb6;--c5:#a0a8b0}}"
      "*{box-sizing:border-box}body{margin:0 auto;padding:24px 20px 48px;max-width:1060px;background:var(--back);"
      "color:var(--text);font:15px/1.45 system-ui,'DejaVu Sans',sans-serif}"
      "h1{font-size:26px;margin:0}h2{font-size:19px;margin:34px 0 10px;border-bottom:1px solid var(--line);"
      "padding-bottom:4px}h3{font-size:16px}.sub{color:var(--soft);margin:2px 0 18px}"
      ".tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:10px}"
      ".tile{background:var(--tile);border-radius:6px;padding:10px 12px}.tile b{display:block;font-size:20px}"
      ".tile span{color:var(--soft);font-size:13px}.bad b{color:var(--bad)}"
      ".plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:14px 20px}"
      "figure{margin:0;break-inside:avoid}figcaption{font-weight:600;margin-bottom:2px}figcaption span{font-weight:400;"
      "margin-left:8px}svg,img{width:100%;height:auto;display:block}"
      ".grid line{stroke:var(--line);stroke-width:1}.label text{fill:var(--soft);font-size:15px}"
      ".curve{fill-opacity:.3;stroke-width:1.3;stroke-linejoin:round}"
      ".curve.c0{fill:var(--c0);stroke:var(--c0)}.curve.c1{fill:var(--c1);stroke:var(--c1)}"
      ".curve.c2{fill:var(--c2);stroke:var(--c2)}.curve.c3{fill:var(--c3);stroke:var(--c3)}"
      ".curve.c4{fill:var(--c4);stroke:var(--c4)}.curve.c5{fill:var(--c5);stroke:var(--c5)}"
      ".state{fill-opacity:.35}.state.c0{fill:var(--c0)}.state.c1{fill:var(--c1)}.state.c2{fill:var(--c2)}"
      ".state.c3{fill:var(--c3)}.state.c4{fill:var(--c4)}.state.c5{fill:var(--c5)}.state.several{fill:var(--soft)}"
      ".bar rect{fill:var(--c0)}span.c0{color:var(--c0)}span.c1{color:var(--c1)}span.c2{color:var(--c2)}"
      "span.c3{color:var(--c3)}span.c4{color:var(--c4)}span.c5{color:var(--c5)}"
      ".wide{overflow-x:auto}table{border-collapse:collapse;width:100%;font-size:14px}"
      "th,td{text-align:left;padding:4px 10px 4px 0;border-bottom:1px solid var(--line);vertical-align:top}"
      "th{color:var(--soft);font-weight:600}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}"
      "tr{break-inside:avoid}"
      "@media print{body{max-width:none;padding:0;font-size:12px}.plots{grid-template-columns:1fr "
      "1fr}h2{break-after:avoid}"
      ".tile{border:1px solid var(--line)}.wide{overflow:visible}}";

QByteArray escaped(const QString &text)
{
    return text.toHtmlEscaped().toUtf8();
}

/// Rows of a table; the first one is its head.
class Table
{
public:
    /// \param numbers  columns that stand at the right
    explicit Table(const QStringList &head, QVector<int> numbers = {})
        : m_numbers(std::move(numbers))
    {
        m_bytes = "<div class=\"wide\"><table><thead>" + row(head, "th") + "</thead><tbody>\n";
    }
    void add(const QStringList &cells)
    {
        m_bytes += row(cells, "td") + '\n';
        m_isEmpty = false;
    }
    bool isEmpty() const { return m_isEmpty; }
    QByteArray html() const { return m_bytes + "</tbody></table></div>\n"; }

private:
    QByteArray row(const QStringList &cells, const QByteArray &kind) const
    {
        QByteArray bytes = "<tr>";
        for (int i = 0; i < cells.size(); ++i)
            bytes += '<' + kind + (m_numbers.contains(i) ? " class=\"n\">" : ">") + escaped(cells.at(i)) + "</" + kind
                + '>';
        return bytes + "</tr>";
    }

    QVector<int> m_numbers;
    QByteArray m_bytes;
    bool m_isEmpty = true;
};

struct NodeFigures
{
    std::uint64_t asked = 0;
    std::uint64_t answered = 0;
    std::uint64_t late = 0;
    std::uint64_t faulted = 0;
    std::uint64_t safe = 0;
    std::uint64_t lost = 0;
};

/// An element of a signal over the time of a report.
struct Trace
{
    int signal = 0;  // of Recording::signalList()
    int element = 0;
    overview::Bucket all;
    std::vector<overview::Bucket> intervals;
};

/// A formula over the time of a report.
struct FormulaTrace
{
    ReportFormula formula;
    std::vector<overview::Bucket> intervals;
};

/// What one walk over all cycles finds.
class Survey
{
public:
    Survey(Recording &recording, const ReportSelection &selection)
        : m_begin(selection.begin)
        , m_span(double(selection.end - selection.begin + 1))
    {
        const std::vector<int> numbers = traceSignals(recording);
        addFormulas(recording, selection.panels, numbers);
        const auto cyclesOfAll = (selection.end - selection.begin) / recording.description().period + 1;
        const auto count = std::size_t(std::clamp<RecordedTime>(cyclesOfAll, 1, Intervals));
        for (Trace &trace : traces)
            trace.intervals.resize(count);
        for (FormulaTrace &trace : formulas)
            trace.intervals.resize(count);
        m_signalCount = recording.table().size();
        RecordedRows rows(recording, numbers, selection.begin, selection.end);
        rows.setOther([this](const QByteArray &topic, const mcap::Message &message) { takeOther(topic, message); });
        while (rows.next()) {
            takeCycle(rows);
            takeValues(rows);
        }
        countNodes();  // of the last cycle
        damages = rows.damages();
    }

    std::vector<Trace> traces;           // of all numeric signals
    std::vector<FormulaTrace> formulas;  // of the layout, each once
    std::uint64_t cycles = 0;
    std::uint64_t skipped = 0;
    std::uint64_t missing = 0;
    std::uint64_t incomplete = 0;  // cycles in which an answer was missing
    bool isTimed = false;
    LatenessHistogram lateness;
    QMap<std::uint16_t, NodeFigures> nodes;
    QMap<std::uint16_t, QString> nodeNames;
    std::vector<std::pair<RecordedTime, QString>> happenings;
    std::uint64_t furtherHappenings = 0;
    int damages = 0;

private:
    /// \return the signals of all traces, each once
    std::vector<int> traceSignals(const Recording &recording)
    {
        std::vector<int> numbers;
        for (std::size_t i = 0; i < recording.signalList().size(); ++i) {
            const QPlcSignalType type = recording.signalList()[i].definition.type;
            for (int element = 0; type.isNumeric() && element < type.count(); ++element) {
                traces.push_back({int(i), element, {}, {}});
                m_columns.push_back(numbers.size());
            }
            if (type.isNumeric())
                numbers.push_back(int(i));
        }
        return numbers;
    }
    /// \param numbers  of signals: the columns of the rows
    void addFormulas(const Recording &recording, const std::vector<ReportPanel> &panels,
                     const std::vector<int> &numbers)
    {
        std::vector<int> columns(recording.signalList().size(), -1);
        for (std::size_t column = 0; column < numbers.size(); ++column)
            columns[std::size_t(numbers[column])] = int(column);
        QStringList texts;
        for (const ReportPanel &panel : panels) {
            for (const ReportPanel::Curve &curve : panel.curves) {
                if (ReportFormula::isFormula(curve.signal))
                    texts << curve.signal;
            }
        }
        texts.removeDuplicates();
        const QStringList calculated = texts.mid(0, MostFormulas);
        for (const QString &text : calculated)
            formulas.push_back({ReportFormula(text, recording, columns), {}});
    }
    void takeValues(const RecordedRows &rows)
    {
        const auto place = [&](std::size_t intervals) {
            return std::min(std::size_t(double(rows.time() - m_begin) / m_span * double(intervals)), intervals - 1);
        };
        for (FormulaTrace &trace : formulas) {
            if (trace.formula.problem().isEmpty())
                trace.intervals[place(trace.intervals.size())].add(trace.formula.next(rows));
        }
        for (std::size_t i = 0; i < traces.size(); ++i) {
            if (!rows.value(m_columns[i]))
                continue;
            Trace &trace = traces[i];
            const double number = rows.number(m_columns[i], trace.element);
            overview::Bucket bucket{number, number, overview::flagOf(rows.quality(m_columns[i]))};
            if (std::isnan(number))
                bucket.flags &= quint8(~overview::HasValue);
            trace.all.add(bucket);
            trace.intervals[place(trace.intervals.size())].add(bucket);
        }
    }
    void happened(RecordedTime time, const QString &text)
    {
        if (happenings.size() < std::size_t(MostHappenings))
            happenings.emplace_back(time, text);
        else
            ++furtherHappenings;
    }
    void takeCycle(const RecordedRows &rows)
    {
        const PlantMessage::Cycle &cycle = rows.cycle();
        ++cycles;
        countNodes();
        if (cycle.skipped > 0)
            happened(
                rows.time(),
                QStringLiteral("the master skipped %1 cycles before cycle %2").arg(cycle.skipped).arg(cycle.number));
        skipped += cycle.skipped;
        incomplete += cycle.flags & RecordedCycle::Incomplete ? 1 : 0;
        const bool isSafe = cycle.flags & RecordedCycle::Safe;
        if (isSafe != m_isSafe)
            happened(rows.time(), isSafe ? QStringLiteral("safe stop") : QStringLiteral("the safe stop is over"));
        m_isSafe = isSafe;
        if ((cycle.flags & RecordedCycle::NewNodes) && cycles > 1)
            happened(rows.time(), QStringLiteral("nodes or leases have changed"));
        if (cycle.flags & RecordedCycle::Timed) {
            isTimed = true;
            lateness.add(cycle.lateness);
        }
    }
    void takeOther(const QByteArray &topic, const mcap::Message &message)
    {
        const QByteArray text = QByteArray::fromRawData(message.bytes, int(message.size));
        if (topic == "/nodes") {
            readNodes(text, &m_exchange);
        } else if (topic == "/rosters") {
            RosterContent roster;
            if (readRoster(text, m_signalCount, &roster)) {
                for (const RosterNode &node : qAsConst(roster.nodes))
                    nodeNames.insert(node.id, node.name);
            }
        } else if (topic == "/gaps") {
            RecordedGap gap;
            readGap(text, &gap);
            missing += gap.cycles;
            happened(RecordedTime(message.time),
                     QStringLiteral("%1 cycles are missing: %2 to %3").arg(gap.cycles).arg(gap.first).arg(gap.last));
        } else if (Happening happening; readHappening(topic, message, &happening)) {
            if (happening.topic != Happening::Statistics)
                happened(happening.time, happening.sentence());
        }
    }
    /// A message of /nodes comes behind the cycle that it belongs to.
    void countNodes()
    {
        for (const RecordedNode &node : m_exchange) {
            NodeFigures &figures = nodes[node.id];
            figures.asked += node.flags & RecordedNode::Asked ? 1 : 0;
            figures.answered += node.flags & RecordedNode::Answered ? 1 : 0;
            figures.late += node.flags & RecordedNode::Late ? 1 : 0;
            figures.faulted += node.flags & RecordedNode::Faulted ? 1 : 0;
            figures.safe += node.flags & RecordedNode::IsSafe ? 1 : 0;
            figures.lost += node.flags & RecordedNode::Lost ? 1 : 0;
        }
    }

    RecordedTime m_begin;
    double m_span;                       // [ns]
    std::vector<std::size_t> m_columns;  // of the traces
    int m_signalCount = 0;
    std::vector<RecordedNode> m_exchange;  // of the newest cycle
    bool m_isSafe = false;
};

QString momentText(RecordedTime time)
{
    return QDateTime::fromMSecsSinceEpoch(time / 1'000'000, Qt::UTC).toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"))
        + QStringLiteral(" UTC");
}

QString durationText(double seconds)
{
    if (seconds < 120.0)
        return QStringLiteral("%1 s").arg(shortNumber(seconds));
    const auto whole = qint64(std::llround(seconds));
    const QString text = QStringLiteral("%1 min %2 s").arg(whole / 60 % 60).arg(whole % 60);
    return whole < 3600 ? text : QStringLiteral("%1 h %2 min").arg(whole / 3600).arg(whole / 60 % 60);
}

QByteArray tile(const QString &value, const QString &name, bool isBad = false)
{
    return "<div class=\"tile" + QByteArray(isBad ? " bad" : "") + "\"><b>" + escaped(value) + "</b><span>"
        + escaped(name) + "</span></div>";
}

class Report
{
public:
    Report(Recording &recording, const ReportSelection &selection)
        : m_recording(recording)
        , m_selection(selection)
        , m_survey(recording, selection)
    {
    }

    QByteArray html() const
    {
        QByteArray page = tiles();
        for (const QString &section : m_selection.sections)
            page += "<section>" + htmlOfMarkdown(section) + "</section>\n";
        page += pictures() + plots() + happenings() + jitter() + nodes() + signalTable();
        return pageOf(name(), subtitle(), page);
    }
    int damages() const { return m_survey.damages; }

private:
    double secondsOf(RecordedTime time) const { return double(time - m_recording.begin()) / 1e9; }
    QString name() const
    {
        const QString plant = m_recording.description().plant;
        return plant.isEmpty() ? QStringLiteral("Plant") : plant;
    }
    /// When, from which files, by which version.
    QString subtitle() const
    {
        const RingDescription &plant = m_recording.description();
        const QString when = m_recording.isTimed() ? momentText(m_selection.begin)
                                                   : QStringLiteral("simulation (%1)").arg(plant.clock);
        QString files = QFileInfo(m_recording.files().front().name).fileName();
        if (m_recording.files().size() > 1)
            files += QStringLiteral(" and %1 more").arg(m_recording.files().size() - 1);
        return QStringLiteral("%1 · %2 · QtPLC %3").arg(when, files, plant.version);
    }
    QByteArray tiles() const
    {
        const RingDescription &plant = m_recording.description();
        QByteArray row = "<div class=\"tiles\">"
            + tile(durationText(double(m_selection.end - m_selection.begin + plant.period) / 1e9),
                   QStringLiteral("duration"))
            + tile(QString::number(m_survey.cycles),
                   QStringLiteral("cycles of %1").arg(shortDuration(double(plant.period) / 1e9)))
            + tile(QString::number(m_survey.missing), QStringLiteral("cycles missing"), m_survey.missing > 0)
            + tile(QString::number(m_survey.skipped), QStringLiteral("cycles skipped by the master"),
                   m_survey.skipped > 0)
            + tile(QString::number(m_survey.incomplete), QStringLiteral("cycles without all answers"),
                   m_survey.incomplete > 0);
        if (m_survey.isTimed)
            row += tile(shortDuration(double(m_survey.lateness.quantile(0.99)) / 1e9),
                        QStringLiteral("lateness, 99 % of the cycles"));
        if (m_survey.damages > 0)
            row += tile(QString::number(m_survey.damages), QStringLiteral("damaged places, left out"), true);
        return row + "</div>\n";
    }
    std::vector<int> chosen() const
    {
        if (!m_selection.signalNumbers.empty())
            return m_selection.signalNumbers;
        std::vector<int> found;
        for (const Trace &trace : m_survey.traces) {
            const bool isKnown = !found.empty() && found.back() == trace.signal;
            if (trace.all.minimum < trace.all.maximum && !isKnown && found.size() < std::size_t(UsualPlots))
                found.push_back(trace.signal);
        }
        return found;
    }
    QByteArray pictures() const
    {
        QByteArray figures;
        for (const ReportSelection::Picture &picture : m_selection.pictures)
            figures += "<figure><figcaption>" + escaped(picture.title) + "</figcaption><img alt=\""
                + escaped(picture.title) + "\" src=\"data:" + mediaTypeOf(picture.bytes) + ";base64,"
                + picture.bytes.toBase64() + "\"></figure>\n";
        return figures.isEmpty() ? figures : "<h2>Pictures</h2>\n" + figures;
    }
    /// What a curve shows.
    struct Shown
    {
        QString unit;
        QPlcValueNames names;
        const std::vector<overview::Bucket> *intervals = nullptr;  // null: see problem
        QString problem;                                           // why it is not drawn, for people
    };
    Shown shownOf(const QString &reference) const
    {
        if (ReportFormula::isFormula(reference)) {
            for (const FormulaTrace &trace : m_survey.formulas) {
                if (trace.formula.text() != reference)
                    continue;
                const QString problem = trace.formula.problem();
                return {trace.formula.unit(), {}, problem.isEmpty() ? &trace.intervals : nullptr, problem};
            }
            return {{}, {}, nullptr, QStringLiteral("a report calculates at most %1 formulas").arg(MostFormulas)};
        }
        if (const Trace *trace = traceOf(reference)) {
            const QPlcSignalDefinition &signal = m_recording.signalList()[std::size_t(trace->signal)].definition;
            return {signal.unit, signal.valueNames, &trace->intervals, {}};
        }
        return {{}, {}, nullptr, QStringLiteral("the recording has no number of this name")};
    }
    /// An element of a signal: "position[2]". Null: it is not in the recording, or no number
    const Trace *traceOf(const QString &reference) const
    {
        static const QRegularExpression form(QStringLiteral("^(?:.*/)?([^/\\[\\]]+)(?:\\[(\\d{1,4})\\])?$"));
        const QRegularExpressionMatch match = form.match(reference);
        const int signal = match.hasMatch() ? m_recording.indexOf(match.captured(1)) : -1;
        const auto found = std::find_if(m_survey.traces.begin(), m_survey.traces.end(), [&](const Trace &trace) {
            return trace.signal == signal && trace.element == match.captured(2).toInt();
        });
        return signal < 0 || found == m_survey.traces.end() ? nullptr : &*found;
    }
    /// The curves of a panel that share an axis.
    struct Group
    {
        QString unit;
        ReportPlot plot;
    };
    /// The drawings of a panel, one for each unit.
    QByteArray panelPlots(const ReportPanel &panel) const
    {
        std::vector<Group> groups;
        QByteArray missing;
        QByteArray drawings;
        for (const ReportPanel::Curve &curve : panel.curves) {
            const Shown shown = shownOf(curve.signal);
            if (!shown.intervals)
                missing += "<p>Not drawn: " + escaped(curve.signal) + ": " + escaped(shown.problem) + ".</p>";
            else if (curve.isBands)
                drawings += bandsOf(panel, curve, shown);
            else
                addCurve(curve, shown, &groups);
        }
        for (Group &group : groups) {
            QStringList parts;
            if (!panel.title.isEmpty())
                parts << panel.title;
            if (group.plot.names.size() == 1)
                parts << group.plot.names.constFirst();
            parts.removeDuplicates();
            group.plot.title = parts.join(QStringLiteral(": "))
                + (group.unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(group.unit));
            drawings += drawingOf(group.plot);
        }
        if (!missing.isEmpty())
            drawings += "<figure><figcaption>" + escaped(panel.title) + "</figcaption>" + missing + "</figure>\n";
        return drawings;
    }
    /// A formula is named without its "=", as in a window.
    static QString nameOf(const ReportPanel::Curve &curve)
    {
        if (!curve.name.isEmpty())
            return curve.name;
        return ReportFormula::isFormula(curve.signal) ? curve.signal.mid(1).trimmed() : curve.signal;
    }
    QByteArray bandsOf(const ReportPanel &panel, const ReportPanel::Curve &curve, const Shown &shown) const
    {
        QStringList title{panel.title, nameOf(curve)};
        title.removeAll({});
        ReportStates states;
        states.title = title.join(QStringLiteral(": "));
        states.begin = secondsOf(m_selection.begin);
        states.end = secondsOf(m_selection.end + 1);
        states.intervals = *shown.intervals;
        states.nameOf = [&shown](double state) {
            const QString name = shown.names.nameOf(qint64(state));
            return name.isEmpty() ? shortNumber(state) : name;
        };
        return drawingOf(states);
    }
    void addCurve(const ReportPanel::Curve &curve, const Shown &shown, std::vector<Group> *groups) const
    {
        auto found
            = std::find_if(groups->begin(), groups->end(), [&](const Group &each) { return each.unit == shown.unit; });
        if (found == groups->end()) {
            ReportPlot plot;
            plot.begin = secondsOf(m_selection.begin);
            plot.end = secondsOf(m_selection.end + 1);
            found = groups->insert(groups->end(), {shown.unit, plot});
        }
        found->plot.curves.push_back(scaled(*shown.intervals, curve.gain, curve.offset));
        found->plot.names << nameOf(curve);
    }
    static std::vector<overview::Bucket> scaled(std::vector<overview::Bucket> buckets, double gain, double offset)
    {
        for (overview::Bucket &bucket : buckets) {
            bucket.minimum = gain * bucket.minimum + offset;
            bucket.maximum = gain * bucket.maximum + offset;
            if (bucket.minimum > bucket.maximum)
                std::swap(bucket.minimum, bucket.maximum);
        }
        return buckets;
    }
    QByteArray plots() const
    {
        QByteArray drawings;
        for (const ReportPanel &panel : m_selection.panels)
            drawings += panelPlots(panel);
        if (m_selection.panels.empty())
            drawings = signalPlots();
        return drawings.isEmpty() ? drawings
                                  : "<h2>Signals over time</h2>\n<div class=\"plots\">" + drawings + "</div>\n";
    }
    QByteArray signalPlots() const
    {
        QByteArray drawings;
        for (const int signal : chosen()) {
            const QPlcSignalDefinition &definition = m_recording.signalList()[std::size_t(signal)].definition;
            ReportPlot plot;
            plot.title = definition.unit.isEmpty() ? definition.name
                                                   : QStringLiteral("%1 [%2]").arg(definition.name, definition.unit);
            plot.begin = secondsOf(m_selection.begin);
            plot.end = secondsOf(m_selection.end + 1);
            for (const Trace &trace : m_survey.traces) {
                if (trace.signal != signal || trace.element >= MostCurves)
                    continue;
                plot.curves.push_back(trace.intervals);
                plot.names << QStringLiteral("[%1]").arg(trace.element);
            }
            drawings += plot.curves.empty() ? QByteArray() : drawingOf(plot);
        }
        return drawings;
    }
    QByteArray happenings() const
    {
        if (m_survey.happenings.empty())
            return "<h2>Events</h2>\n<p>None: no safe stop, no cycle skipped or missing, no change of nodes.</p>\n";
        Table table({QStringLiteral("time [s]"), QStringLiteral("event")}, {0});
        for (const auto &[time, text] : m_survey.happenings)
            table.add({QString::number(secondsOf(time), 'f', 3), text});
        if (m_survey.furtherHappenings > 0)
            table.add({{}, QStringLiteral("and %1 more").arg(m_survey.furtherHappenings)});
        return "<h2>Events</h2>\n" + table.html();
    }
    QByteArray jitter() const
    {
        if (!m_survey.isTimed)
            return "<h2>Jitter</h2>\n<p>The cycles were not timed: this clock does not follow real time.</p>\n";
        const LatenessHistogram &lateness = m_survey.lateness;
        Table table({QStringLiteral("lateness of the cycles"), QStringLiteral("at most")}, {1});
        const QVector<QPair<QString, double>> parts{
            {QStringLiteral("50 %"), 0.5}, {QStringLiteral("99 %"), 0.99}, {QStringLiteral("99.9 %"), 0.999}};
        for (const auto &part : parts)
            table.add({part.first, shortDuration(double(lateness.quantile(part.second)) / 1e9)});
        table.add({QStringLiteral("all"), shortDuration(double(lateness.most) / 1e9)});
        return "<h2>Jitter</h2>\n<div class=\"plots\">" + drawingOf(lateness) + "<div>" + table.html()
            + "</div></div>\n";
    }
    QByteArray nodes() const
    {
        Table table({QStringLiteral("node"), QStringLiteral("asked"), QStringLiteral("answered"),
                     QStringLiteral("late"), QStringLiteral("faulted"), QStringLiteral("in its safe state"),
                     QStringLiteral("lost")},
                    {1, 2, 3, 4, 5, 6});
        for (auto it = m_survey.nodes.begin(); it != m_survey.nodes.end(); ++it)
            table.add({m_survey.nodeNames.value(it.key(), QString::number(it.key())), QString::number(it->asked),
                       QString::number(it->answered), QString::number(it->late), QString::number(it->faulted),
                       QString::number(it->safe), QString::number(it->lost)});
        return table.isEmpty() ? QByteArray() : "<h2>Nodes</h2>\n<p>In cycles of the recording.</p>\n" + table.html();
    }
    QByteArray signalTable() const
    {
        Table table({QStringLiteral("signal"), QStringLiteral("smallest"), QStringLiteral("largest"),
                     QStringLiteral("unit"), QStringLiteral("quality"), QStringLiteral("description")},
                    {1, 2});
        for (const Trace &trace : m_survey.traces) {
            const QPlcSignalDefinition &definition = m_recording.signalList()[std::size_t(trace.signal)].definition;
            const bool hasValue = trace.all.flags & overview::HasValue;
            table.add({definition.type.isArray() ? QStringLiteral("%1[%2]").arg(definition.name).arg(trace.element)
                                                 : definition.name,
                       hasValue ? shortNumber(trace.all.minimum) : QString(),
                       hasValue ? shortNumber(trace.all.maximum) : QString(), definition.unit,
                       qualityText(trace.all.flags), trace.element == 0 ? definition.description : QString()});
        }
        return "<h2>All signals</h2>\n" + table.html();
    }
    static QString qualityText(quint8 flags)
    {
        QStringList kinds;
        if (flags & overview::HasHeld)
            kinds << QStringLiteral("held at times");
        if (flags & overview::HasSafe)
            kinds << QStringLiteral("safe at times");
        if (flags & overview::HasInvalid)
            kinds << (flags & overview::HasValue ? QStringLiteral("invalid at times") : QStringLiteral("invalid"));
        return kinds.isEmpty() ? QStringLiteral("good") : kinds.join(QStringLiteral(", "));
    }

    const Recording &m_recording;
    const ReportSelection &m_selection;
    Survey m_survey;
};

QStringList cellsOf(const QString &line)
{
    QStringList cells = line.mid(1).split(QLatin1Char('|'));
    if (!cells.isEmpty() && cells.constLast().trimmed().isEmpty())
        cells.removeLast();
    for (QString &cell : cells)
        cell = cell.trimmed();
    return cells;
}

bool isRule(const QString &line)
{
    return std::all_of(line.begin(), line.end(), [](QChar c) { return QStringLiteral("|-: ").contains(c); });
}

}  // namespace

QByteArray pageOf(const QString &name, const QString &subtitle, const QByteArray &body)
{
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
           "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
           "<meta name=\"color-scheme\" content=\"light dark\"><title>"
        + escaped(name) + " – report</title><style>" + style + "</style></head>\n<body><h1>" + escaped(name)
        + "</h1><p class=\"sub\">" + escaped(subtitle) + "</p>\n" + body + "</body></html>\n";
}

QByteArray htmlOfMarkdown(const QString &text)
{
    QByteArray html;
    QByteArray paragraph;
    std::unique_ptr<Table> table;
    bool isInList = false;
    const auto end = [&] {
        if (!paragraph.isEmpty())
            html += "<p>" + paragraph + "</p>\n";
        if (table)
            html += table->html();
        if (isInList)
            html += "</ul>\n";
        paragraph.clear();
        table.reset();
        isInList = false;
    };
    const QStringList lines = text.split(QLatin1Char('\n'));
    for (const QString &raw : lines) {
        const QString line = raw.trimmed();
        if (line.startsWith(QLatin1Char('|'))) {
            if (!table) {
                end();
                table = std::make_unique<Table>(cellsOf(line));
            } else if (!isRule(line)) {
                table->add(cellsOf(line));
            }
        } else if (line.startsWith(QLatin1Char('#'))) {
            end();
            const QByteArray level = line.startsWith(QLatin1String("## ")) ? "h3" : "h2";
            html += '<' + level + '>' + escaped(line.section(QLatin1Char(' '), 1)) + "</" + level + ">\n";
        } else if (line.startsWith(QLatin1String("- "))) {
            if (!isInList) {
                end();
                html += "<ul>\n";
            }
            isInList = true;
            html += "<li>" + escaped(line.mid(2)) + "</li>\n";
        } else if (line.isEmpty()) {
            end();
        } else {
            if (table || isInList)
                end();
            paragraph += (paragraph.isEmpty() ? "" : " ") + escaped(line);
        }
    }
    end();
    return html;
}

QByteArray mediaTypeOf(const QByteArray &picture)
{
    if (picture.startsWith("\x89PNG\r\n"))
        return "image/png";
    if (picture.startsWith("\xff\xd8\xff"))
        return "image/jpeg";
    const QByteArray head = picture.left(1000).trimmed();
    return head.startsWith("<svg") || (head.startsWith("<?xml") && head.contains("<svg")) ? "image/svg+xml" : "";
}

QByteArray reportOf(Recording &recording, const ReportSelection &selection, int *damages)
{
    Report report(recording, selection);
    *damages = report.damages();
    return report.html();
}

}  // namespace qplc

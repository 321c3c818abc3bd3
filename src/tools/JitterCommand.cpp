// SPDX-License-Identifier: Apache-2.0
// jitter: what the statistics of master and nodes say of their punctuality.
#include "Commands.h"
#include "HistogramText.h"
#include "TerminalText.h"

#include <array>

namespace tools {

namespace messages = qplc::messages;

namespace {

using Window = QPlcDistribution QPlcDurationStatistics::*;

QString titleOf(Window window)
{
    return window == &QPlcDurationStatistics::sinceStart ? QStringLiteral("since start") : QStringLiteral("last 10 s");
}

/// A distribution of one of the master or a node: what the tables and the histograms have rows for.
struct Distribution
{
    QString who;
    QString title;
    QPlcDurationStatistics duration;
    bool isSlack = false;
};

QVector<Distribution> distributionsOf(const messages::Statistics &statistics)
{
    QVector<Distribution> all;
    QString who = QStringLiteral("Master");
    const auto add
        = [&](const char *title, const std::optional<QPlcDurationStatistics> &duration, bool isSlack = false) {
              if (duration)
                  all.append({who, QString::fromLatin1(title), *duration, isSlack});
          };
    add("lateness", statistics.master.lateness);
    const auto addMore = [&](const auto &measures) {
        add("round trip", measures.roundTrip);
        add("execution", measures.execution);
        add("slack", measures.slack, true);
    };
    addMore(statistics.master);
    for (const messages::NodeMeasures &node : statistics.nodes) {
        who = node.name;
        addMore(node);
    }
    return all;
}

/// What the columns show: of slack the little that was left is of interest, of all else the most
/// that it took.
std::array<double, 5> figuresOf(const QPlcDistribution &of, bool isSlack)
{
    if (isSlack)
        return {of.mean, double(of.p50), double(of.p01), double(of.p001), double(of.minimum)};
    return {of.mean, double(of.p50), double(of.p99), double(of.p999), double(of.maximum)};
}

void printWindow(const QVector<Distribution> &distributions, Window window)
{
    TextTable table;
    table.addColumn(titleOf(window));
    table.addColumn(QString());
    for (const char *title : {"count", "mean", "p50", "worst 1 %", "worst 0.1 %", "worst"})
        table.addColumn(QString::fromLatin1(title), Right);
    for (const Distribution &distribution : distributions) {
        const QPlcDistribution &numbers = distribution.duration.*window;
        QStringList cells{distribution.who, distribution.title, QString::number(numbers.count)};
        for (double figure : figuresOf(numbers, distribution.isSlack))
            cells << (numbers.count > 0 ? durationText(figure) : QString());
        table.addRow(cells);
    }
    table.print();
}

void printCounters(const QString &who, const QMap<QString, double> &counters)
{
    QStringList texts;
    for (auto it = counters.begin(); it != counters.end(); ++it)
        texts << QStringLiteral("%1 %2").arg(it.key()).arg(it.value(), 0, 'f', 0);
    if (!texts.isEmpty())
        printWrapped(printable(who) + QStringLiteral(": "), displayWidth(printable(who)) + 2,
                     printable(texts.join(QStringLiteral(", "))));
}

void printWorstCycles(const std::vector<QPlcWorstCycle> &cycles)
{
    if (cycles.empty())
        return;
    TextTable table;
    for (const char *title : {"worst cycle", "lateness", "round trip", "execution", "slack"})
        table.addColumn(QString::fromLatin1(title), Right);
    table.addColumn(QStringLiteral("stages"));
    for (const QPlcWorstCycle &cycle : cycles) {
        QStringList stages;
        for (const QPlcWorstCycle::Stage &stage : cycle.stages)
            stages << QStringLiteral("%1 %2").arg(stage.name, durationText(double(stage.duration)));
        table.addRow({QString::number(cycle.cycle), durationText(double(cycle.lateness)),
                      durationText(double(cycle.roundTrip)), durationText(double(cycle.execution)),
                      durationText(double(cycle.slack)), stages.join(QStringLiteral(", "))});
    }
    printLine(QString());
    table.print();
}

void printTables(const messages::Statistics &statistics)
{
    const QVector<Distribution> distributions = distributionsOf(statistics);
    for (Window window : {&QPlcDurationStatistics::sinceStart, &QPlcDurationStatistics::last10s}) {
        printWindow(distributions, window);
        printLine(QString());
    }
    printCounters(QStringLiteral("Master"), statistics.master.counters);
    for (const messages::NodeMeasures &node : statistics.nodes)
        printCounters(node.name, node.counters);
    printWorstCycles(statistics.worst);
}

void printHistograms(const messages::Statistics &statistics)
{
    const QVector<Distribution> distributions = distributionsOf(statistics);
    for (const Distribution &distribution : distributions) {
        const QPlcDistribution &numbers = distribution.duration.sinceStart;
        printLine(toned(printable(QStringLiteral("%1 %2, since start: %3 values, p50 %4, p99 %5, max %6")
                                      .arg(distribution.who, distribution.title)
                                      .arg(numbers.count)
                                      .arg(durationText(double(numbers.p50)), durationText(double(numbers.p99)),
                                           durationText(double(numbers.maximum)))),
                        Tone::Title));
        const QStringList lines = histogramLines(numbers.bins, terminalSize().columns);
        for (const QString &line : lines)
            printLine(line);
        printLine(QString());
    }
}

}  // namespace

int showJitter(const CommandCall &call)
{
    const bool wantsHistograms = call.application.isSet(QStringLiteral("hist"));
    messages::Statistics statistics;
    if (!call.connect() || !call.askFor(messages::GetStatistics{wantsHistograms}, &statistics))
        return call.exitCode();
    if (call.isJson())
        printJson(call.client.lastAnswer());
    else if (distributionsOf(statistics).isEmpty())
        printLine(QStringLiteral("no statistics yet; start the plant: qtplc start"));
    else
        wantsHistograms ? printHistograms(statistics) : printTables(statistics);
    return QPlcCoreApplication::Success;
}

}  // namespace tools

// SPDX-License-Identifier: Apache-2.0
// jitter: what the statistics of master and nodes say of their punctuality.
#include "Commands.h"
#include "HistogramText.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

struct Quantity
{
    const char *field;
    const char *title;
};

const Quantity quantities[]
    = {{"lateness", "lateness"}, {"roundTrip", "round trip"}, {"execution", "execution"}, {"slack", "slack"}};

const Quantity windows[] = {{"sinceStart", "since start"}, {"last10s", "last 10 s"}};

/// A distribution of one of the master or a node: what the tables and the histograms have rows for.
struct Distribution
{
    QString who;
    QString title;
    QJsonObject windows;
};

QVector<Distribution> distributionsOf(const QString &who, const QJsonObject &fields)
{
    QVector<Distribution> found;
    for (const Quantity &quantity : quantities) {
        const QJsonValue value = fields.value(QLatin1String(quantity.field));
        if (value.isObject())
            found.append({who, QString::fromLatin1(quantity.title), value.toObject()});
    }
    return found;
}

QVector<Distribution> distributionsOf(const QJsonObject &statistics)
{
    QVector<Distribution> all
        = distributionsOf(QStringLiteral("Master"), statistics.value(QStringLiteral("master")).toObject());
    const QJsonArray nodes = statistics.value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &node : nodes)
        all += distributionsOf(node[QStringLiteral("name")].toString(), node.toObject());
    return all;
}

/// What the columns show: of slack the little that was left is of interest, of all else the most that it took.
QStringList tailFields(const Distribution &distribution)
{
    const bool isSlack = distribution.title == QLatin1String("slack");
    return isSlack ? QStringList{QStringLiteral("mean"), QStringLiteral("p50"), QStringLiteral("p01"),
                                 QStringLiteral("p001"), QStringLiteral("minimum")}
                   : QStringList{QStringLiteral("mean"), QStringLiteral("p50"), QStringLiteral("p99"),
                                 QStringLiteral("p999"), QStringLiteral("maximum")};
}

void printWindow(const QVector<Distribution> &distributions, const Quantity &window)
{
    TextTable table;
    table.addColumn(QString::fromLatin1(window.title));
    table.addColumn(QString());
    for (const char *title : {"count", "mean", "p50", "worst 1 %", "worst 0.1 %", "worst"})
        table.addColumn(QString::fromLatin1(title), Right);
    for (const Distribution &distribution : distributions) {
        const QJsonObject numbers = distribution.windows.value(QLatin1String(window.field)).toObject();
        const double count = numbers.value(QStringLiteral("count")).toDouble();
        QStringList cells{distribution.who, distribution.title, QString::number(count, 'f', 0)};
        const QStringList fields = tailFields(distribution);
        for (const QString &field : fields)
            cells << (count > 0.0 ? durationText(numbers.value(field).toDouble()) : QString());
        table.addRow(cells);
    }
    table.print();
}

void printCounters(const QJsonObject &statistics)
{
    const auto print = [](const QString &who, const QJsonObject &counters) {
        QStringList texts;
        for (auto it = counters.begin(); it != counters.end(); ++it)
            texts << QStringLiteral("%1 %2").arg(it.key()).arg(it.value().toDouble(), 0, 'f', 0);
        if (!texts.isEmpty())
            printWrapped(printable(who) + QStringLiteral(": "), displayWidth(printable(who)) + 2,
                         printable(texts.join(QStringLiteral(", "))));
    };
    const QString field = QStringLiteral("counters");
    print(QStringLiteral("Master"), statistics.value(QStringLiteral("master"))[field].toObject());
    const QJsonArray nodes = statistics.value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &node : nodes)
        print(node[QStringLiteral("name")].toString(), node[field].toObject());
}

void printWorstCycles(const QJsonArray &cycles)
{
    if (cycles.isEmpty())
        return;
    TextTable table;
    table.addColumn(QStringLiteral("worst cycle"), Right);
    for (const Quantity &quantity : quantities)
        table.addColumn(QString::fromLatin1(quantity.title), Right);
    table.addColumn(QStringLiteral("stages"));
    for (const QJsonValue &cycle : cycles) {
        QStringList cells{QString::number(cycle[QStringLiteral("cycle")].toDouble(), 'f', 0)};
        for (const Quantity &quantity : quantities)
            cells << durationText(cycle[QLatin1String(quantity.field)].toDouble());
        QStringList stages;
        const QJsonArray parts = cycle[QStringLiteral("stages")].toArray();
        for (const QJsonValue &part : parts)
            stages << QStringLiteral("%1 %2").arg(part[QStringLiteral("name")].toString(),
                                                  durationText(part[QStringLiteral("duration")].toDouble()));
        table.addRow(cells << stages.join(QStringLiteral(", ")));
    }
    printLine(QString());
    table.print();
}

void printTables(const QJsonObject &statistics)
{
    const QVector<Distribution> distributions = distributionsOf(statistics);
    for (const Quantity &window : windows) {
        printWindow(distributions, window);
        printLine(QString());
    }
    printCounters(statistics);
    printWorstCycles(statistics.value(QStringLiteral("worst")).toArray());
}

void printHistograms(const QJsonObject &statistics)
{
    const QVector<Distribution> distributions = distributionsOf(statistics);
    for (const Distribution &distribution : distributions) {
        const QJsonObject numbers = distribution.windows.value(QLatin1String(windows[0].field)).toObject();
        printLine(toned(printable(QStringLiteral("%1 %2, %3: %4 values, p50 %5, p99 %6, max %7")
                                      .arg(distribution.who, distribution.title, QLatin1String(windows[0].title))
                                      .arg(numbers.value(QStringLiteral("count")).toDouble(), 0, 'f', 0)
                                      .arg(durationText(numbers.value(QStringLiteral("p50")).toDouble()),
                                           durationText(numbers.value(QStringLiteral("p99")).toDouble()),
                                           durationText(numbers.value(QStringLiteral("maximum")).toDouble()))),
                        Tone::Title));
        const QStringList lines
            = histogramLines(numbers.value(QStringLiteral("bins")).toArray(), terminalSize().columns);
        for (const QString &line : lines)
            printLine(line);
        printLine(QString());
    }
}

}  // namespace

int showJitter(const CommandCall &call)
{
    const bool wantsHistograms = call.application.isSet(QStringLiteral("hist"));
    QPlcMessage answer;
    if (!call.connect()
        || !call.askFor(QPlcMessage::GetStatistics, QPlcMessage::Statistics,
                        {{QStringLiteral("histograms"), wantsHistograms}}, &answer))
        return call.exitCode();
    const QJsonObject statistics = answer.fields();
    if (call.isJson())
        printJson(QJsonDocument(statistics));
    else if (distributionsOf(statistics).isEmpty())
        printLine(QStringLiteral("no statistics yet; start the plant: qtplc start"));
    else
        wantsHistograms ? printHistograms(statistics) : printTables(statistics);
    return QPlcCoreApplication::Success;
}

}  // namespace tools

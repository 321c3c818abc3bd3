// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"
#include "node/state/StateText.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace tools {

namespace {

constexpr int labelWidth = 10;

struct NodeColumn
{
    const char *title;
    const char *field;
    Alignment alignment;
    enum Shown { Always, UnlessZero, InDetail } shown;  // all of them with --verbose
};

const NodeColumn nodeColumns[] = {
    {"node", "name", Left, NodeColumn::Always},
    {"transport", "transport", Left, NodeColumn::Always},
    {"address", "address", Left, NodeColumn::InDetail},
    {"number", "id", Right, NodeColumn::InDetail},
    {"state", "state", Left, NodeColumn::Always},
    {"critical", "critical", Left, NodeColumn::InDetail},
    {"policy", "policy", Left, NodeColumn::Always},
    {"listener", "listener", Left, NodeColumn::InDetail},
    {"every", "every", Right, NodeColumn::InDetail},
    {"in", "inputs", Right, NodeColumn::Always},
    {"out", "outputs", Right, NodeColumn::Always},
    {"late", "lateAnswers", Right, NodeColumn::UnlessZero},
    {"doubled", "duplicates", Right, NodeColumn::UnlessZero},
    {"rejected", "rejected", Right, NodeColumn::UnlessZero},
    {"forged", "forged", Right, NodeColumn::UnlessZero},
    {"resent", "resent", Right, NodeColumn::UnlessZero},
};

/// Whether a column has anything to say: a counter that is zero for all nodes has not.
bool isShown(const NodeColumn &column, const QJsonArray &nodes, bool verbose)
{
    if (verbose || column.shown != NodeColumn::UnlessZero)
        return verbose || column.shown == NodeColumn::Always;
    return std::any_of(nodes.begin(), nodes.end(), [&column](const QJsonValue &node) {
        return node[QLatin1String(column.field)].toDouble() > 0.0;
    });
}

void printField(const char *label, const QString &value, Tone tone = Tone::Plain)
{
    printWrapped(padded(QString::fromLatin1(label), labelWidth), labelWidth, toned(printable(value), tone));
}

/// "Real time", "Scaled 20 times", "Lockstep"
QString clockText(const QJsonObject &state)
{
    const QString clock = state.value(QStringLiteral("clock")).toString();
    if (clock == QLatin1String("Scaled"))
        return QStringLiteral("Scaled %1 times").arg(state.value(QStringLiteral("scale")).toDouble());
    return qplc::stateText(clock);
}

/// "late 3, missed 1": those that are not zero.
QString countersText(const QJsonObject &counters, bool verbose)
{
    QStringList texts;
    for (auto it = counters.begin(); it != counters.end(); ++it) {
        if (verbose || it.value().toDouble() != 0.0)
            texts << QStringLiteral("%1 %2").arg(it.key(), it.value().toVariant().toString());
    }
    return texts.isEmpty() ? QStringLiteral("all zero") : texts.join(QStringLiteral(", "));
}

/// Who injects what on purpose; empty: nobody.
QString faultsText(const QJsonObject &state)
{
    QStringList texts;
    const auto add = [&texts](const QString &name, const QJsonObject &of) {
        if (of.contains(QStringLiteral("faults")))
            texts << QStringLiteral("%1 (%2)").arg(name, of.value(QStringLiteral("faults")).toString());
    };
    add(QStringLiteral("Master"), state);
    const QJsonArray nodes = state.value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &node : nodes)
        add(node.toObject().value(QStringLiteral("name")).toString(), node.toObject());
    return texts.join(QStringLiteral(", "));
}

bool isState(const NodeColumn &column)
{
    return qstrcmp(column.field, "state") == 0;
}

QString textOf(const NodeColumn &column, const QString &value)
{
    return isState(column) ? qplc::stateText(value) : value;
}

Tone toneOf(const NodeColumn &column, const QString &value)
{
    if (column.shown == NodeColumn::UnlessZero)
        return value == QLatin1String("0") ? Tone::Plain : Tone::Caution;
    return isState(column) ? toneOfState(value) : Tone::Plain;
}

void printNodes(const QJsonArray &nodes, bool verbose)
{
    QVector<NodeColumn> columns;
    TextTable table;
    for (const NodeColumn &column : nodeColumns) {
        if (!isShown(column, nodes, verbose))
            continue;
        table.addColumn(QString::fromLatin1(column.title), column.alignment);
        columns << column;
    }
    for (const QJsonValue &node : nodes) {
        QStringList values, cells;
        for (const NodeColumn &column : qAsConst(columns)) {
            values << node[QLatin1String(column.field)].toVariant().toString();
            cells << textOf(column, values.constLast());
        }
        table.addRow(cells);
        for (int i = 0; i < columns.size(); ++i)
            table.setTone(i, toneOf(columns.at(i), values.at(i)));
    }
    table.print();
}

}  // namespace

int showState(const CommandCall &call)
{
    QPlcMessage answer;
    if (!call.connect() || !call.ask(QPlcMessage(QPlcMessage::GetState), &answer))
        return call.exitCode();
    const QJsonObject state = answer.fields();
    if (call.isJson()) {
        printJson(QJsonDocument(state));
        return QPlcCoreApplication::Success;
    }
    const double period = state.value(QStringLiteral("period")).toDouble() * 1e-9;
    const quint64 cycle = answer.hex64(QStringLiteral("cycle"));
    const bool verbose = call.application.isSet(QStringLiteral("verbose"));
    const bool isArmed = state.value(QStringLiteral("armed")).toBool();
    printField("state",
               qplc::stateText(answer.text(QStringLiteral("state")))
                   + (isArmed ? QStringLiteral(", armed") : QString()),
               toneOfState(answer.text(QStringLiteral("state"))));
    if (!answer.text(QStringLiteral("reason")).isEmpty())
        printField("reason", answer.text(QStringLiteral("reason")));
    if (!answer.text(QStringLiteral("remains")).isEmpty())
        printField("remains", answer.text(QStringLiteral("remains")));
    printField("cycle", QStringLiteral("%1 (%2 s)").arg(cycle).arg(double(cycle) * period, 0, 'f', 3));
    printField("period", QStringLiteral("%1 ms").arg(period * 1e3));
    printField("clock", clockText(state));
    printField("profile",
               QStringLiteral("%1: %2").arg(answer.text(QStringLiteral("profile")),
                                            answer.text(QStringLiteral("profileReason"))));
    printField("counters", countersText(state.value(QStringLiteral("counters")).toObject(), verbose));
    printField("session", answer.text(QStringLiteral("session")));
    printField("digest", answer.text(QStringLiteral("digest")));
    if (const QString faults = faultsText(state); !faults.isEmpty())
        printField("FAULTS", QStringLiteral("injected on purpose by %1").arg(faults), Tone::Caution);
    printLine(QString());
    printNodes(state.value(QStringLiteral("nodes")).toArray(), verbose);
    return QPlcCoreApplication::Success;
}

}  // namespace tools

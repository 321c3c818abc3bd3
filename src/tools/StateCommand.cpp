// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

struct NodeColumn
{
    const char *title;
    const char *field;
    TextTable::Alignment alignment;
    bool isDetail;  // with --verbose only
};

const NodeColumn nodeColumns[] = {
    {"node", "name", TextTable::Left, false},          {"transport", "transport", TextTable::Left, false},
    {"address", "address", TextTable::Left, true},     {"number", "id", TextTable::Right, true},
    {"state", "state", TextTable::Left, false},        {"critical", "critical", TextTable::Left, true},
    {"policy", "policy", TextTable::Left, false},      {"listener", "listener", TextTable::Left, true},
    {"every", "every", TextTable::Right, true},        {"in", "inputs", TextTable::Right, false},
    {"out", "outputs", TextTable::Right, false},       {"late", "lateAnswers", TextTable::Right, false},
    {"doubled", "duplicates", TextTable::Right, true}, {"rejected", "rejected", TextTable::Right, false},
    {"forged", "forged", TextTable::Right, false},     {"resent", "resent", TextTable::Right, true},
};

void printField(const char *label, const QString &value)
{
    printLine(QStringLiteral("%1%2").arg(QString::fromLatin1(label), -10).arg(printable(value)));
}

/// "scaled 20 times", "lockstep"
QString clockText(const QJsonObject &state)
{
    const QString clock = state.value(QStringLiteral("clock")).toString();
    if (clock == QLatin1String("Scaled"))
        return QStringLiteral("Scaled %1").arg(state.value(QStringLiteral("scale")).toDouble());
    return clock;
}

QString countersText(const QJsonObject &counters)
{
    QStringList texts;
    for (auto it = counters.begin(); it != counters.end(); ++it)
        texts << QStringLiteral("%1 %2").arg(it.key(), it.value().toVariant().toString());
    return texts.join(QStringLiteral(", "));
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

void printNodes(const QJsonArray &nodes, bool verbose)
{
    QStringList fields;
    TextTable table;
    for (const NodeColumn &column : nodeColumns) {
        if (column.isDetail && !verbose)
            continue;
        table.addColumn(QString::fromLatin1(column.title), column.alignment);
        fields << QString::fromLatin1(column.field);
    }
    for (const QJsonValue &node : nodes) {
        QStringList cells;
        for (const QString &field : qAsConst(fields))
            cells << node.toObject().value(field).toVariant().toString();
        table.addRow(cells);
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
    const bool isArmed = state.value(QStringLiteral("armed")).toBool();
    printField("state", answer.text(QStringLiteral("state")) + (isArmed ? QStringLiteral(", armed") : QString()));
    if (!answer.text(QStringLiteral("reason")).isEmpty())
        printField("reason", answer.text(QStringLiteral("reason")));
    if (!answer.text(QStringLiteral("remains")).isEmpty())
        printField("remains", answer.text(QStringLiteral("remains")));
    printField("cycle", QStringLiteral("%1 (%2 s)").arg(cycle).arg(double(cycle) * period, 0, 'f', 3));
    printField("period", QStringLiteral("%1 ms").arg(period * 1e3));
    printField("clock", clockText(state));
    printField("counters", countersText(state.value(QStringLiteral("counters")).toObject()));
    printField("session", answer.text(QStringLiteral("session")));
    printField("digest", answer.text(QStringLiteral("digest")));
    if (const QString faults = faultsText(state); !faults.isEmpty())
        printField("FAULTS", QStringLiteral("injected on purpose by %1").arg(faults));
    printLine(QString());
    printNodes(state.value(QStringLiteral("nodes")).toArray(), call.application.isSet(QStringLiteral("verbose")));
    return QPlcCoreApplication::Success;
}

}  // namespace tools

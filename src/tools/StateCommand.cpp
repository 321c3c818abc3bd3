// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"
#include "node/state/StateText.h"
#include "realtime/TimeSource.h"

#include <QtCore/QDateTime>

#include <algorithm>

namespace tools {

namespace messages = qplc::messages;

namespace {

constexpr int labelWidth = 10;

struct NodeColumn
{
    const char *title;
    Alignment alignment;
    enum Shown { Always, IsState, UnlessZero, InDetail } shown;  // all of them with --verbose
    QString (*text)(const QPlcNodeInfo &node);
};

QString yesNo(bool is)
{
    return is ? QStringLiteral("true") : QStringLiteral("false");
}

template<auto member>
QString numberOf(const QPlcNodeInfo &node)
{
    return QString::number(node.*member);
}

const NodeColumn nodeColumns[] = {
    {"node", Left, NodeColumn::Always, [](const QPlcNodeInfo &node) { return node.name; }},
    {"transport", Left, NodeColumn::Always, &qplc::transportText},
    {"address", Left, NodeColumn::InDetail, [](const QPlcNodeInfo &node) { return node.address; }},
    {"number", Right, NodeColumn::InDetail, &numberOf<&QPlcNodeInfo::id>},
    {"state", Left, NodeColumn::IsState, [](const QPlcNodeInfo &node) { return qplc::stateText(node.state); }},
    {"critical", Left, NodeColumn::InDetail, [](const QPlcNodeInfo &node) { return yesNo(node.critical); }},
    {"policy", Left, NodeColumn::Always, [](const QPlcNodeInfo &node) { return node.policy; }},
    {"listener", Left, NodeColumn::InDetail, [](const QPlcNodeInfo &node) { return yesNo(node.listener); }},
    {"every", Right, NodeColumn::InDetail, &numberOf<&QPlcNodeInfo::every>},
    {"in", Right, NodeColumn::Always, &numberOf<&QPlcNodeInfo::inputs>},
    {"out", Right, NodeColumn::Always, &numberOf<&QPlcNodeInfo::outputs>},
    {"late", Right, NodeColumn::UnlessZero, &numberOf<&QPlcNodeInfo::lateAnswers>},
    {"doubled", Right, NodeColumn::UnlessZero, &numberOf<&QPlcNodeInfo::duplicates>},
    {"rejected", Right, NodeColumn::UnlessZero, &numberOf<&QPlcNodeInfo::rejected>},
    {"forged", Right, NodeColumn::UnlessZero, &numberOf<&QPlcNodeInfo::forged>},
    {"resent", Right, NodeColumn::UnlessZero, &numberOf<&QPlcNodeInfo::resent>},
};

bool isZero(const QString &text)
{
    return text == QLatin1String("0");
}

/// Whether a column has anything to say: a counter that is zero for all nodes has not.
bool isShown(const NodeColumn &column, const QVector<QPlcNodeInfo> &nodes, bool verbose)
{
    if (verbose || column.shown != NodeColumn::UnlessZero)
        return verbose || column.shown != NodeColumn::InDetail;
    return std::any_of(nodes.begin(), nodes.end(),
                       [&column](const QPlcNodeInfo &node) { return !isZero(column.text(node)); });
}

void printField(const char *label, const QString &value, Tone tone = Tone::Plain)
{
    printWrapped(padded(QString::fromLatin1(label), labelWidth), labelWidth, toned(printable(value), tone));
}

/// "Real time", "Scaled 20 times", "Lockstep"
QString clockText(const messages::State &state)
{
    return state.clock == messages::ClockKind::Scaled ? QStringLiteral("Scaled %1 times").arg(state.scale)
                                                      : qplc::stateText(state.clock);
}

/// "late 3, missed 1": those that are not zero.
QString countersText(const QMap<QString, double> &counters, bool verbose)
{
    QStringList texts;
    for (auto it = counters.begin(); it != counters.end(); ++it) {
        if (verbose || it.value() != 0.0)
            texts << QStringLiteral("%1 %2").arg(it.key()).arg(it.value(), 0, 'f', 0);
    }
    return texts.isEmpty() ? QStringLiteral("all zero") : texts.join(QStringLiteral(", "));
}

/// Who injects what on purpose; empty: nobody.
QString faultsText(const messages::State &state)
{
    QStringList texts;
    const auto add = [&texts](const QString &name, const QString &faults) {
        if (!faults.isEmpty())
            texts << QStringLiteral("%1 (%2)").arg(name, faults);
    };
    add(QStringLiteral("Master"), state.faults);
    for (const QPlcNodeInfo &node : state.nodes)
        add(node.name, node.faultPlan);
    return texts.join(QStringLiteral(", "));
}

Tone toneOf(const NodeColumn &column, const QPlcNodeInfo &node)
{
    if (column.shown == NodeColumn::UnlessZero)
        return isZero(column.text(node)) ? Tone::Plain : Tone::Caution;
    return column.shown == NodeColumn::IsState ? toneOfState(messages::stateNamed(node.state)) : Tone::Plain;
}

void printNodes(const QVector<QPlcNodeInfo> &nodes, bool verbose)
{
    QVector<const NodeColumn *> columns;
    TextTable table;
    for (const NodeColumn &column : nodeColumns) {
        if (!isShown(column, nodes, verbose))
            continue;
        table.addColumn(QString::fromLatin1(column.title), column.alignment);
        columns << &column;
    }
    for (const QPlcNodeInfo &node : nodes) {
        QStringList cells;
        for (const NodeColumn *column : qAsConst(columns))
            cells << column->text(node);
        table.addRow(cells);
        for (int i = 0; i < columns.size(); ++i)
            table.setTone(i, toneOf(*columns.at(i), node));
    }
    table.print();
}

Tone toneOf(messages::RecorderState state)
{
    switch (state) {
    case messages::RecorderState::DiskFull:
    case messages::RecorderState::Failing:
    case messages::RecorderState::Stalled:
    case messages::RecorderState::Gone:
        return Tone::Caution;
    case messages::RecorderState::Unknown:
    case messages::RecorderState::None:
    case messages::RecorderState::Recording:
    case messages::RecorderState::Stopped:
        break;
    }
    return Tone::Plain;
}

void printRecorder(const messages::RecorderEntry &recorder)
{
    printField("recorder", qplc::recorderText(recorder), toneOf(recorder.state));
    if (recorder.missing > 0)
        printField("", QStringLiteral("%1 cycles of this phase are missing").arg(recorder.missing), Tone::Caution);
    if (!recorder.file.isEmpty())
        printField("", recorder.file);
    if (recorder.state == messages::RecorderState::Recording && !recorder.error.isEmpty())
        printField("", QStringLiteral("last error: ") + recorder.error);
}

}  // namespace

int showState(const CommandCall &call)
{
    messages::State state;
    if (!call.connect() || !call.ask(messages::GetState(), &state))
        return call.exitCode();
    if (call.isJson()) {
        printJson(call.client.lastAnswer());
        return QPlcCoreApplication::Success;
    }
    const double period = double(state.period.count()) * 1e-9;
    const bool verbose = call.application.isSet(QStringLiteral("verbose"));
    printField("state", qplc::stateText(state.state) + (state.armed ? QStringLiteral(", armed") : QString()),
               toneOfState(state.state));
    if (!state.reason.isEmpty())
        printField("reason", state.reason);
    if (!state.remains.isEmpty())
        printField("remains", state.remains);
    if (!state.missing.isEmpty())
        printField("missing", state.missing, Tone::Caution);
    const QDate today = QDateTime::fromMSecsSinceEpoch(qplc::wallClockNow() / 1'000'000).date();
    for (const messages::EvictedEntry &entry : qAsConst(state.evicted))
        printField("evicted", QStringLiteral("%1: %2").arg(entry.name, qplc::evictedText(entry, today)), Tone::Caution);
    printField("cycle",
               QStringLiteral("%1 (%2 s)").arg(state.cycle.number).arg(double(state.cycle.number) * period, 0, 'f', 3));
    printField("period", QStringLiteral("%1 ms").arg(period * 1e3));
    printField("clock", clockText(state));
    printField("profile", QStringLiteral("%1: %2").arg(state.profile, state.profileReason));
    printField("counters", countersText(state.counters, verbose));
    printField("session", QPlcMessage::fromHex64(state.session));
    printField("digest", QPlcMessage::fromHex64(state.digest));
    if (state.recorder)
        printRecorder(*state.recorder);
    if (const QString faults = faultsText(state); !faults.isEmpty())
        printField("FAULTS", QStringLiteral("injected on purpose by %1").arg(faults), Tone::Caution);
    printLine(QString());
    printNodes(state.nodes, verbose);
    return QPlcCoreApplication::Success;
}

}  // namespace tools

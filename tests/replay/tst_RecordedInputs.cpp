// SPDX-License-Identifier: Apache-2.0
#include "RecordedMaster.h"
#include "ScriptedNode.h"
#include "Stepping.h"
#include "node/api/QPlcMasterNodePrivate.h"
#include "replay/NodePayloads.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

using Sent = std::map<std::pair<QString, quint64>, QByteArray>;  // of node and cycle

/// Compares what a recording says of the inputs of nodes with what they were sent.
class Comparison : public RecordedCycles::Reader
{
public:
    explicit Comparison(const Sent &sent)
        : m_sent(sent)
    {
    }
    bool begin(const RingDescription &description, const QPlcSignalTable &table) override
    {
        m_description = description;
        m_image = std::make_unique<ProcessImage>(table);
        return true;
    }
    bool joined(const RecordedStart &start) override
    {
        joins[start.id] = start;
        return true;
    }
    bool cycle(const RecordedRow &row) override
    {
        flags |= row.cycle.flags;
        skipped += row.cycle.skipped;
        rawInputs += int(row.rawInputs.size());
        rawOutputs += int(row.rawOutputs.size());
        if (!row.roster)
            return fail(row, "nobody", "no roster");
        for (const RosterNode &node : row.roster->nodes) {
            const auto sent = m_sent.find({node.name, row.cycle.number});
            if (sent == m_sent.end())
                continue;
            QByteArray rebuilt;
            if (!NodePayloads(*m_image, node, m_description.ownSignals).inputs(row, &rebuilt))
                return fail(row, node.name, "cannot be rebuilt");
            if (rebuilt.left(sent->second.size()) != sent->second)
                return fail(row, node.name, rebuilt.toHex(' ') + " instead of " + sent->second.toHex(' '));
            ++compared;
            stages = std::max(stages, node.stage + 1);
        }
        return true;
    }

    int compared = 0;
    int stages = 0;
    int rawInputs = 0;
    int rawOutputs = 0;
    quint64 skipped = 0;
    quint32 flags = 0;
    QString difference;  // empty: there is none
    std::map<quint16, RecordedStart> joins;

private:
    bool fail(const RecordedRow &row, const QString &node, const QByteArray &text)
    {
        difference = QString("cycle %1, node %2: %3").arg(row.cycle.number).arg(node, QString::fromLatin1(text));
        return false;
    }
    const Sent &m_sent;
    RingDescription m_description;
    std::unique_ptr<ProcessImage> m_image;
};

}  // namespace

// From a recording follows what each node was sent in each cycle.
class tst_RecordedInputs : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void inputsFollowFromTheRecording_data();
    void inputsFollowFromTheRecording();
    void inputsFollowFromTheRecordingInRealTime_data();
    void inputsFollowFromTheRecordingInRealTime();
    void aNodeThatJoinsHasItsInitialValuesInTheRecording();
    void theHistoryOfANodeSaysWhatItHasComputed();

private:
    void noteSent(QPlcMasterNode &master, Sent *sent);
};

/// After a step, the payloads are still what was sent.
void tst_RecordedInputs::noteSent(QPlcMasterNode &master, Sent *sent)
{
    const auto &parts = *QPlcMasterNodePrivate::of(master).parts;
    for (const auto &slot : parts.registry.nodes()) {
        if (slot->due && slot->inputs)
            (*sent)[{slot->name, parts.cycle.cycle()}] = QByteArray(slot->inputs, int(slot->inputLayout.size()));
    }
}

void tst_RecordedInputs::inputsFollowFromTheRecording_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"in process", "tcp", "udp", "shared memory"})
        QTest::newRow(kind) << kind;
}

void tst_RecordedInputs::inputsFollowFromTheRecording()
{
    QFETCH(QString, kind);
    Chain chain;
    auto guest
        = std::make_unique<Probe>("Guest", std::vector<Probe::In>{{"s5"}, {"s1"}}, std::vector<const char *>{"s5"});
    chain.third.setReceivesQuality(true);
    guest->setReceivesQuality(true);
    RecordedMaster master(QPlcClock::external());
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY2(master.admitOver(*node, kind), qPrintable(master.errorString() + node->errorString()));
    ScriptedTool tool("Anna");
    QVERIFY(tool.greetAt(master.serverPort()));
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    Sent sent;
    const auto steps = [&](int count) {
        for (int i = 0; i < count; ++i) {
            stepAside(master);
            noteSent(master, &sent);
        }
    };
    const auto set = [&](const char *name, double value) { return master.setSignalValue(name, QPlcValue(value)); };
    steps(10);
    QVERIFY(set("set", 4.5) && set("moved", 3.0));
    steps(10);
    const bool isLate = kind != "in process";  // a node of the process of the master joins no phase
    if (isLate)
        QVERIFY(guest->connectToMasterAndWaitForConnected(master.protocol("tcp")));
    const auto isGuestThere = [&] {
        steps(1);
        return guest->state() == QPlcSlaveNode::RealTime || !isLate;
    };
    QVERIFY(waitUntil(isGuestThere, 10s));
    steps(10);
    tool.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"s3"}}, {"timeout", 3.6e12}});
    steps(5);
    tool.ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"s3", "12.5"}}}});
    steps(5);
    guest.reset();
    QTest::qWait(20);
    steps(10);
    tool.ask(QPlcMessage::ReleaseLease, {{"signals", QJsonArray{"s3"}}});
    steps(40);
    QVERIFY2(master.finish(), qPrintable(master.error));

    Comparison comparison(sent);
    QVERIFY2(RecordedCycles::read({master.recording()}, comparison, &master.error), qPrintable(master.error));
    QVERIFY2(comparison.difference.isEmpty(), qPrintable(comparison.difference));
    QCOMPARE(comparison.compared, int(sent.size()));
    QVERIFY(comparison.compared >= 360);
    QCOMPARE(comparison.stages, 4);
    QVERIFY(comparison.flags & RecordedCycle::SetValues);
    QVERIFY(comparison.flags & RecordedCycle::NewNodes);
    QVERIFY2(comparison.rawOutputs > 0, "what is leased, and refused, is there as it was sent");
}

void tst_RecordedInputs::inputsFollowFromTheRecordingInRealTime_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"in process", "tcp", "udp", "shared memory"})
        QTest::newRow(kind) << kind;
}

/// Nodes that stall are late, or let the master skip cycles.
void tst_RecordedInputs::inputsFollowFromTheRecordingInRealTime()
{
    QFETCH(QString, kind);
    Chain chain;
    chain.first.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() % 17 == 5)
            beBusyFor(7ms);
    };
    chain.second.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() % 23 == 7)
            beBusyFor(3ms);
    };
    RecordedMaster master(QPlcClock::realTime());
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY2(master.admitOver(*node, kind), qPrintable(master.errorString() + node->errorString()));
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(master.waitForCycles(60));
    QVERIFY(master.setSignalValue("set", QPlcValue(2.5)) && master.setSignalValue("moved", QPlcValue(-2.0)));
    QVERIFY(master.waitForCycles(200));
    QVERIFY2(master.finish(), qPrintable(master.error));

    Sent sent;
    for (Probe *node : {&chain.first, &chain.second, &chain.third, &chain.integrator}) {
        for (const auto &[cycle, values] : node->seen())
            sent[{node->name(), cycle}] = values;
    }
    Comparison comparison(sent);
    QVERIFY2(RecordedCycles::read({master.recording()}, comparison, &master.error), qPrintable(master.error));
    QVERIFY2(comparison.difference.isEmpty(), qPrintable(comparison.difference));
    QVERIFY(comparison.compared >= 400);
    if (kind == "in process")
        QVERIFY2(comparison.skipped > 0, "a node in the process of the master holds the cycle up");
    else
        QVERIFY2(comparison.rawInputs > 0, "a stage begins without the outputs that are late");
}

void tst_RecordedInputs::aNodeThatJoinsHasItsInitialValuesInTheRecording()
{
    Chain chain;
    RecordedMaster master(QPlcClock::external());
    QVERIFY(master.listen());
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY(master.admitOver(*node, node == &chain.first ? "in process" : "tcp"));
    QVERIFY(master.setSignalValue("set", QPlcValue(1.5)));
    master.startRealTime();
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    stepAside(master);
    QVERIFY2(master.finish(), qPrintable(master.error));

    Comparison comparison({});
    QVERIFY2(RecordedCycles::read({master.recording()}, comparison, &master.error), qPrintable(master.error));
    QCOMPARE(comparison.joins.size(), std::size_t(4));
    const auto &nodes = QPlcMasterNodePrivate::of(master).parts->registry.nodes();
    for (const auto &slot : nodes) {
        const RecordedStart &start = comparison.joins[slot->id];
        QCOMPARE(start.first, std::uint64_t(0));
        QCOMPARE(std::uint32_t(start.inputs.size()), slot->inputLayout.size());
        QCOMPARE(std::uint32_t(start.outputs.size()), slot->outputLayout.size());
    }
    double set = 0.0;
    std::memcpy(&set, comparison.joins[nodes.front()->id].inputs.constData() + 8, sizeof set);
    QCOMPARE(set, 1.5);
}

void tst_RecordedInputs::theHistoryOfANodeSaysWhatItHasComputed()
{
    NodeSlot::Exchange exchange;
    exchange.note(4, 0);
    QCOMPARE(exchange.history, 0u);
    exchange.note(5, 1);
    QCOMPARE(exchange.history, 0b1u);
    exchange.note(8, 2);                  // the answer to 6 was lost
    QCOMPARE(exchange.history, 0b1110u);  // 6, 5 and 4
    QCOMPARE(exchange.cycle, std::uint64_t(8));
    exchange.note(100, 40);
    QCOMPARE(exchange.history, 0u);
}

QTEST_GUILESS_MAIN(tst_RecordedInputs)
#include "tst_RecordedInputs.moc"

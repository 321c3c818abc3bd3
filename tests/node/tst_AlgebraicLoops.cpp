// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SameCycleFixtures.h"

#include <algorithm>
#include <atomic>
#include <optional>

// Who is in which stage, who is refused, and nodes that come and go.
class tst_AlgebraicLoops : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void masterSignalsAreReadWithoutDelay();
    void masterReturnsTheScheduleOnRequest();
    void aLoopIsRefusedWithItsPath();
    void refusedNodeChangesNoOtherNode();
    void joiningNodesMoveTheOthersBetweenStages();
    void aTwoPhaseNodeThatJoinsBeginsWithItsInitialOutputs();
};

void tst_AlgebraicLoops::masterSignalsAreReadWithoutDelay()
{
    TestMaster master;
    QVERIFY(master.setTimeSignal("time"));
    class Reader : public QPlcCompactSlaveNode
    {
    public:
        Reader()
            : QPlcCompactSlaveNode("Reader")
        {
        }
        QPlcInput<qint64> time{this, "time", QPlcInputTiming::SameCycle};
        QPlcInput<float> free{this, "free"};
    } reader;
    QVERIFY(master.addLocalNode(&reader));
    const QPlcSchedule schedule = master.schedule();
    QCOMPARE(stageTexts(schedule), QStringList{"Reader step"});
    QCOMPARE(schedule.links.size(), 2);
    QCOMPARE(schedule.links.at(0).from, QString("Master"));
    QCOMPARE(schedule.links.at(0).age, 0);
    QVERIFY(schedule.links.at(0).sameCycle);
    QCOMPARE(schedule.links.at(1).from, QString());
    QCOMPARE(schedule.links.at(1).age, 0);
    QVERIFY(!schedule.links.at(1).sameCycle);
    QVERIFY(TestMaster().schedule().stages.isEmpty());
}

void tst_AlgebraicLoops::masterReturnsTheScheduleOnRequest()
{
    TestMaster master;
    QVERIFY(master.listen());
    Integrator integrator;
    Adder adder("Adder", "sum", "setpoint", QPlcInputTiming::LastCycle);
    QVERIFY(master.addLocalNode(&integrator));
    QVERIFY(master.addLocalNode(&adder));
    ScriptedNode tool;
    QVERIFY(tool.connectTo(master.serverPort()));
    tool.send(QPlcMessage::Hello, tool.helloFields());
    QCOMPARE(tool.next().kind(), QPlcMessage::Hello);
    tool.send(QPlcMessage::GetSchedule);
    const QPlcMessage schedule = tool.next();
    QCOMPARE(schedule.kind(), QPlcMessage::Schedule);
    const auto turn = [](const char *node, const char *phase) { return QJsonObject{{"node", node}, {"phase", phase}}; };
    QCOMPARE(schedule.fields().value("stages").toArray(),
             (QJsonArray{QJsonArray{turn("Integrator", "outputs")}, QJsonArray{turn("Adder", "step")},
                         QJsonArray{turn("Integrator", "update")}}));
    QCOMPARE(schedule.fields().value("links").toArray(),
             (QJsonArray{
                 QJsonObject{
                     {"signal", "setpoint"}, {"from", "Adder"}, {"to", "Integrator"}, {"age", 0}, {"sameCycle", true}},
                 QJsonObject{
                     {"signal", "sum"}, {"from", "Integrator"}, {"to", "Adder"}, {"age", 1}, {"sameCycle", false}}}));
}

void tst_AlgebraicLoops::aLoopIsRefusedWithItsPath()
{
    TestMaster master;
    Adder first("First", "echo", "setpoint", QPlcInputTiming::SameCycle);
    Adder second("Second", "setpoint", "sum", QPlcInputTiming::SameCycle);
    Adder third("Third", "sum", "echo", QPlcInputTiming::SameCycle);
    Adder itself("Itself", "echo", "echo", QPlcInputTiming::SameCycle);
    QVERIFY(!master.addLocalNode(&itself));
    QVERIFY2(master.errorString().contains(": Itself.echo -> Itself.echo -> Itself.echo;"),
             qPrintable(master.errorString()));
    QVERIFY(master.addLocalNode(&first));
    QVERIFY(master.addLocalNode(&second));
    QVERIFY(!master.addLocalNode(&third));
    QCOMPARE(master.error(), QPlcMasterNode::NodeError);
    QCOMPARE(
        master.errorString(),
        QString("node 'Third' closes an algebraic loop: Third.sum -> Third.echo -> First.echo -> First.setpoint -> "
                "Second.setpoint -> Second.sum -> Third.sum; make one of these inputs not same-cycle, or one of these "
                "nodes two-phase"));
    QCOMPARE(master.writer("echo"), QString());
    third.setTwoPhase(true);  // the second way out
    QVERIFY(master.addLocalNode(&third));
    master.removeLocalNode(&third);
    Adder slow("Slow", "sum", "echo", QPlcInputTiming::LastCycle);  // the first one
    QVERIFY(master.addLocalNode(&slow));
}

void tst_AlgebraicLoops::refusedNodeChangesNoOtherNode()
{
    TestMaster master;
    QVERIFY(master.listen());
    Adder first("First", "echo", "setpoint", QPlcInputTiming::SameCycle);
    QVERIFY(first.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    QSignalSpy refused(&master, &QPlcMasterNode::nodeRefused);
    ScriptedNode node("Second");
    node.inputs = QStringList{"setpoint"};
    node.outputs = QStringList{"echo"};
    node.features = QStringList{"sameCycle"};
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    QJsonObject fields = node.registerFields();
    QJsonObject input = fields.value("inputs").toArray().at(0).toObject();
    input.insert("sameCycle", true);
    fields.insert("inputs", QJsonArray{input});
    node.send(QPlcMessage::Register, fields);
    const QPlcMessage rejected = node.next();
    QCOMPARE(rejected.kind(), QPlcMessage::Rejected);
    QCOMPARE(rejected.text("error"), QString("AlgebraicLoop"));
    QVERIFY2(rejected.text("text").contains(
                 "Second.setpoint -> Second.echo -> First.echo -> First.setpoint -> Second.setpoint"),
             qPrintable(rejected.text("text")));
    QCOMPARE(refused.size(), 1);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(first.counters().missed, quint64(0));
    master.stop();
    first.disconnectFromMaster();
}

void tst_AlgebraicLoops::joiningNodesMoveTheOthersBetweenStages()
{
    TestMaster master;
    QVERIFY(master.listen());
    Adder last("Last", "echo", "sum", QPlcInputTiming::SameCycle);
    Adder local("Local", "setpoint", "jitter", QPlcInputTiming::SameCycle);
    QVERIFY(last.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QVERIFY(master.addLocalNode(&local));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    for (int round = 0; round < 5; ++round) {
        Adder first("First", "free", "setpoint", QPlcInputTiming::SameCycle);
        Adder middle("Middle", "setpoint", "echo", QPlcInputTiming::SameCycle);
        QVERIFY(middle.connectToMasterAndWaitForConnected(master.protocol("udp")));
        QVERIFY(first.connectToMasterAndWaitForConnected(master.protocol("tcp")));
        QTRY_VERIFY(first.counters().cycles > 10 && middle.counters().cycles > 10);
        QCOMPARE(stageTexts(master.schedule()), (QStringList{"First step", "Local step, Middle step", "Last step"}));
        QCOMPARE(master.signalValue("sum").toReal(), 3.0);
        QCOMPARE(first.counters().missed + middle.counters().missed, quint64(0));
        first.disconnectFromMaster();
        middle.disconnectFromMaster();
        QTRY_COMPARE(master.nodes().size(), 2);
        QVERIFY(master.waitForCycles(master.statistics().cycles + 10));
    }
    QCOMPARE(last.counters().missed, quint64(0));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    master.stop();
    last.disconnectFromMaster();
}

void tst_AlgebraicLoops::aTwoPhaseNodeThatJoinsBeginsWithItsInitialOutputs()
{
    TestMaster master;
    QVERIFY(master.listen());
    QVERIFY(master.setSignalValue("setpoint", 1.0));
    Adder reader("Reader", "sum", "echo", QPlcInputTiming::SameCycle);
    QVector<double> seen;
    std::atomic<int> count{0};
    seen.reserve(1000);
    reader.onStep = [&](const QPlcCycle &, double sum) {
        if (sum > 0.0 && seen.size() < 1000)
            seen << sum;
        count = seen.size();
    };
    QVERIFY(master.addLocalNode(&reader));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    Integrator integrator;
    QVERIFY(integrator.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QTRY_VERIFY(count >= 100);
    master.stop();
    for (int i = 0; i < seen.size(); ++i)
        QCOMPARE(seen.at(i), 1.0 + i);  // no value twice, none left out
    integrator.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_AlgebraicLoops)
#include "tst_AlgebraicLoops.moc"

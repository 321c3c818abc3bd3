// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SameCycleFixtures.h"
#include "ScriptedMaster.h"

#include <algorithm>
#include <optional>

// Same-cycle inputs and two-phase nodes, one by one: what they read, and what goes over the wire.
class tst_SameCycle : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void sameCycleInputsHaveNoDeadTime_data();
    void sameCycleInputsHaveNoDeadTime();
    void everyKindOfInputMayBeSameCycle_data();
    void everyKindOfInputMayBeSameCycle();
    void twoPhaseNodesCloseTheLoopWithoutDeadTime_data();
    void twoPhaseNodesCloseTheLoopWithoutDeadTime();
    void defaultNodesRegisterWithoutNewFields();
    void orderedNodesRegisterTheirSameCycleInputs();
    void orderedNodesRefuseAnOlderMaster();
    void aTwoPhaseNodeAnswersWithTheNextOutputs();
    void answerOfATwoPhaseNodeIsUsedInTheNextCycle();
    void twoPhaseValuesAreCheckedToo();
};

namespace {

/// As the others have it, for sums that grow beyond the limits of the setpoint.
QPlcSignalTable unlimitedTable()
{
    return QPlcSignalTable::fromIni(testTable().toIni().replace("min = -10\nmax = 10\n", ""));
}

}  // namespace

void tst_SameCycle::sameCycleInputsHaveNoDeadTime_data()
{
    addTransports();
}

void tst_SameCycle::sameCycleInputsHaveNoDeadTime()
{
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    EchoNode echo;
    echo.setSameCycle(true);
    CounterNode counter;
    QVERIFY(join(master, echo, kind));  // the reader comes first
    QVERIFY(join(master, counter, kind));
    QCOMPARE(stageTexts(master.schedule()), (QStringList{"Counter step", "Echo step"}));
    QCOMPARE(ageOf(master.schedule(), "count", "Echo"), 0);
    QCOMPARE(ageOf(master.schedule(), "echo", "Counter"), 1);
    master.setCycleLimit(100);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("count").toInt(), 100);
    QCOMPARE(master.signalValue("echo").toReal(), 100.0);  // and not 99
    QCOMPARE(master.signalValue("sum").toReal(),
             0.5 + 99 * 50.0);  // the other link is one cycle old: 0.5, 1, 2, ... 99
    echo.disconnectFromMaster();
    counter.disconnectFromMaster();
}

void tst_SameCycle::everyKindOfInputMayBeSameCycle_data()
{
    QTest::addColumn<int>("node");
    QTest::newRow("QPlcInput") << 0;
    QTest::newRow("QPlcBoundInput") << 1;
    QTest::newRow("QPlcCompactSignal") << 2;
    QTest::newRow("list of indices") << 3;
    QTest::newRow("IO node") << 4;
}

void tst_SameCycle::everyKindOfInputMayBeSameCycle()
{
    QFETCH(int, node);
    class Reader : public QPlcCompactSlaveNode
    {
    public:
        Reader()
            : QPlcCompactSlaveNode("Reader")
        {
        }
        void step(const QPlcCycle &cycle) override { late = late || (cycle.number() > 0 && value() != 1.0); }
        std::function<double()> value;
        bool late = false;
        int bound = 0;
    } reader;
    class ListReader : public QPlcSlaveNode
    {
    public:
        using QPlcSlaveNode::QPlcSlaveNode;
        QPlcSignalIndexList declareInputSignals() override
        {
            QPlcSignalIndexList list;
            list.insert("count", QPlcInputTiming::SameCycle);
            return list;
        }
        QPlcSignalList realTimeout(const QPlcSignalList &) override { return {}; }
    } lists("Reader");
    TestMaster master;
    QPlcSignalIndexTable::setCurrent(testTable());
    QPlcIOSlaveNode io("Reader");
    QPlcSignalIndexList indices;
    indices.insert("count", QPlcInputTiming::SameCycle);
    indices.insert("count");  // once said it stays
    io.setInputSignalIndices(indices);
    std::optional<QPlcInput<int>> input;
    std::optional<QPlcBoundInput<int>> boundInput;
    std::optional<QPlcCompactSignal> compact;
    if (node == 0)
        input.emplace(&reader, "count", QPlcInputTiming::SameCycle);
    else if (node == 1)
        boundInput.emplace(&reader, "count", &reader.bound, QPlcInputTiming::SameCycle);
    else if (node == 2)
        compact.emplace("count", QPlcCompactSignal::Input, &reader, QPlcInputTiming::SameCycle);
    QPlcSlaveNode &chosen = node == 3 ? static_cast<QPlcSlaveNode &>(lists)
        : node == 4                   ? static_cast<QPlcSlaveNode &>(io)
                                      : reader;
    int count = 0;
    CounterNode counter;
    counter.onStep = [&](const QPlcCycle &cycle) { count = int(cycle.number()) + 1; };
    reader.value = [&] {
        const double read = input ? double(*input)
            : boundInput          ? double(reader.bound)
            : compact             ? double(*compact)
                                  : 0.0;
        return read / count;
    };
    QVERIFY2(master.addLocalNode(&chosen), qPrintable(master.errorString()));
    QVERIFY(master.addLocalNode(&counter));
    QCOMPARE(ageOf(master.schedule(), "count", "Reader"), 0);
    master.setCycleLimit(50);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY(!reader.late);
    if (node == 4)
        QCOMPARE(io.inputSignals().value(testTable().indexOf("count")).toInt(), 50);
}

void tst_SameCycle::twoPhaseNodesCloseTheLoopWithoutDeadTime_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("lists");
    for (const char *kind : {"inprocess", "udp", "tcp"}) {
        QTest::addRow("ports, %s", kind) << kind << false;
        QTest::addRow("lists, %s", kind) << kind << true;
    }
}

void tst_SameCycle::twoPhaseNodesCloseTheLoopWithoutDeadTime()
{
    QFETCH(QString, kind);
    QFETCH(bool, lists);
    TestMaster master(QPlcClock::lockstep(), unlimitedTable());
    QVERIFY(master.listen());
    Integrator ports;
    ListIntegrator list;
    QPlcSlaveNode &integrator = lists ? static_cast<QPlcSlaveNode &>(list) : ports;
    Adder adder("Adder", "sum", "setpoint", QPlcInputTiming::SameCycle);
    QVector<double> seen;
    adder.onStep = [&](const QPlcCycle &, double sum) { seen << sum; };
    QVERIFY2(join(master, integrator, kind), qPrintable(integrator.errorString() + master.errorString()));
    QVERIFY(join(master, adder, kind));
    QCOMPARE(stageTexts(master.schedule()), (QStringList{"Integrator outputs", "Adder step", "Integrator update"}));
    master.setCycleLimit(5);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QTRY_COMPARE(adder.state(), QPlcSlaveNode::Off);  // its thread has ended
    // s(0) = 1, s(k + 1) = s(k) + s(k) + 1
    QCOMPARE(seen, (QVector<double>{1, 3, 7, 15, 31}));
    QCOMPARE(master.signalValue("sum").toReal(), 31.0);
    QCOMPARE(master.signalValue("setpoint").toReal(), 32.0);
    integrator.disconnectFromMaster();
    adder.disconnectFromMaster();
}

void tst_SameCycle::defaultNodesRegisterWithoutNewFields()
{
    ScriptedMaster master;
    EchoNode node;
    QVERIFY(master.admit(node, master.udp()));
    QCOMPARE(master.messages.at(0).fields().value("features").toArray(), QJsonArray());
    const QJsonObject request = master.messages.at(1).fields();
    QCOMPARE(master.messages.at(1).kind(), QPlcMessage::Register);
    QVERIFY(!request.contains("twoPhase"));
    QCOMPARE(request.value("inputs").toArray().at(0).toObject().keys(),
             (QStringList{"name", "safety", "type", "unit"}));
    node.disconnectFromMaster();
}

void tst_SameCycle::orderedNodesRegisterTheirSameCycleInputs()
{
    ScriptedMaster master;
    Integrator node;
    node.connectToMaster(master.udp());
    const QPlcMessage hello = master.next();
    QCOMPARE(hello.fields().value("features").toArray(), QJsonArray{"sameCycle"});
    QJsonObject fields = master.helloFields();
    fields.insert("features", QJsonArray{"sameCycle"});
    master.send(QPlcMessage::Hello, fields);
    const QPlcMessage request = master.next();
    QCOMPARE(request.kind(), QPlcMessage::Register);
    QVERIFY(request.fields().value("twoPhase").toBool());
    QVERIFY(request.fields().value("inputs").toArray().at(0).toObject().value("sameCycle").toBool());
    QVERIFY(!request.fields().value("outputs").toArray().at(0).toObject().contains("sameCycle"));
    node.disconnectFromMaster();

    TestMaster real;
    QVERIFY(real.listen());
    for (const QJsonArray &offered : {QJsonArray(), QJsonArray{"sameCycle", "levitation"}}) {
        ScriptedNode scripted;
        QVERIFY(scripted.connectTo(real.serverPort()));
        QJsonObject greeting = scripted.helloFields();
        greeting.insert("features", offered);
        scripted.send(QPlcMessage::Hello, greeting);
        QCOMPARE(scripted.next().fields().value("features").toArray(),
                 offered.isEmpty() ? QJsonArray() : QJsonArray{"sameCycle"});
    }
}

void tst_SameCycle::orderedNodesRefuseAnOlderMaster()
{
    ScriptedMaster master;
    ListIntegrator node;
    QSignalSpy failed(&node, &QPlcSlaveNode::errorOccurred);
    node.connectToMaster(master.udp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Hello, master.helloFields());
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(node.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(node.errorString().contains("does not know same-cycle inputs"), qPrintable(node.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Rejected);
}

void tst_SameCycle::aTwoPhaseNodeAnswersWithTheNextOutputs()
{
    ScriptedMaster master;
    Integrator node;
    node.setSignalTable(unlimitedTable());
    node.connectToMaster(master.udp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QJsonObject fields = master.helloFields();
    fields.insert("features", QJsonArray{"sameCycle"});
    master.send(QPlcMessage::Hello, fields);
    master.send(QPlcMessage::Registered, master.registeredFields(master.next()));
    master.send(QPlcMessage::CyclicChannelAttached);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    master.send(QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(master.next().bytes("values"), QPlcValue(1.0).toBytes());  // y(0)
    master.send(QPlcMessage::InitializeWithValues, {{"values", QPlcMessage::fromBytes(QPlcValue(2.0).toBytes())}});
    QCOMPARE(master.next().kind(), QPlcMessage::Initialized);
    QVERIFY(master.start());
    master.request(0, QPlcValue(10.0).toBytes());
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(master.answers.at(0).payload, QPlcValue(11.0).toBytes());  // y(1)
    master.request(0, QPlcValue(10.0).toBytes(), 1);                    // again: the same answer
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(master.answers.at(1).bytes, master.answers.at(0).bytes);
    master.request(1, QPlcValue(20.0).toBytes());
    QVERIFY(master.waitForAnswers(3));
    QCOMPARE(master.answers.at(2).payload, QPlcValue(31.0).toBytes());
    node.disconnectFromMaster();
}

void tst_SameCycle::answerOfATwoPhaseNodeIsUsedInTheNextCycle()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode model;
    model.initialValues = QPlcValue(100.0).toBytes();
    model.onRequest = [&](const ScriptedNode::Request &request) {
        if (request.status == qplc::FrameStatus::Complete)
            model.answer(request.cycle, 101.0 + double(model.requests.size() - 1));  // y(k + 1)
    };
    QVERIFY(registerOrdered(model, master.serverPort(), true, true));
    Adder adder("Adder", "echo", "sum", QPlcInputTiming::SameCycle);
    Adder old("Old", "echo", "setpoint", QPlcInputTiming::LastCycle);
    QVector<double> seen;
    QVector<double> seenBefore;
    adder.onStep = [&](const QPlcCycle &, double echo) { seen << echo; };
    old.onStep = [&](const QPlcCycle &, double echo) { seenBefore << echo; };
    QVERIFY(master.addLocalNode(&adder));
    QVERIFY(master.addLocalNode(&old));
    master.setCycleLimit(4);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(seen, (QVector<double>{100, 101, 102, 103}));
    QCOMPARE(seenBefore, (QVector<double>{100, 100, 101, 102}));
    QCOMPARE(master.signalValue("echo").toReal(), 103.0);
}

void tst_SameCycle::twoPhaseValuesAreCheckedToo()
{
    for (const bool isLocal : {true, false}) {
        LogCapture log;
        TestMaster master;
        QVERIFY(master.listen());
        Integrator integrator;
        Adder adder("Adder", "sum", "setpoint", QPlcInputTiming::LastCycle);
        adder.onStep = [&](const QPlcCycle &cycle, double) {
            if (cycle.number() == 3)
                integrator.sum = qQNaN();
        };
        QVERIFY(join(master, integrator, isLocal ? "inprocess" : "udp"));
        QVERIFY(master.addLocalNode(&adder));
        master.setCycleLimit(12);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(log.matching("sum of Integrator: nan is not a finite number; held").size(), 1);
        QVERIFY(master.signalQuality("sum").heldCycles() >= 7);
        QVERIFY(std::isfinite(master.signalValue("sum").toReal()));
        integrator.disconnectFromMaster();
    }
}

QTEST_GUILESS_MAIN(tst_SameCycle)
#include "tst_SameCycle.moc"

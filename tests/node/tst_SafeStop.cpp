// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SafeNode.h"
#include "SameCycleFixtures.h"

using namespace std::chrono_literals;
using qplc::SafeStopFlag;

namespace {

QPlcSignalTable safeTable()
{
    return QPlcSignalTable::fromIni(
        "[time]\ntype = DateTime\n[setpoint]\ntype = Real64\nsafe = -2\n[free]\ntype = Real32\n"
        "[echo]\ntype = Real64\nsafe = 0.25\n[count]\ntype = Int32\nmin = 3\ninitial = 4\n"
        "[sum]\ntype = Real64\n");
}

/// Two phases: what it says in a cycle was known before it began.
class EarlyNode : public QPlcCompactSlaveNode
{
public:
    EarlyNode()
        : QPlcCompactSlaveNode(QStringLiteral("Early"))
    {
        setTwoPhase(true);
    }

protected:
    void outputs() override { m_echo = 9.0; }

private:
    QPlcOutput<double> m_echo{this, "echo"};
};

}  // namespace

// The safe stop of a master: what it tells its nodes, how it is left, and what arming has to do
// with it.
class tst_SafeStop : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void nodesEnterSafeStateAndStopComputing();
    void onlyAResetLeavesTheSafeStop();
    void allNodesGetTheSafeValuesOfTheTable();
    void answersDuringASafeStopAreIgnored();
    void valuesComputedBeforeTheSafeStopAreIgnored();
    void leasedSignalsBecomeSafeToo();
    void nodesOfEveryTransportAreSafe_data();
    void nodesOfEveryTransportAreSafe();
    void lockstepKeepsItsPeriodDuringASafeStop();
    void listenersContinueAndMayJoinDuringASafeStop();
    void safeStopWithoutCyclesEndsSequencesAndLatchesNothing();
    void controlChannelCarriesSafeStopAndReset();
    void aLongReasonIsCut();
    void aResetEndsOnlyTheSafeStopThatItsSenderHasSeen();
    void anArmedStartNeedsItsTokenAndReadiness();
};

void tst_SafeStop::nodesEnterSafeStateAndStopComputing()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    SafeNode winch;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&winch));
    QVERIFY(master.addLocalNode(&counter));
    QSignalSpy told(&master, &QPlcMasterNode::safelyStopped);
    QSignalSpy safe(&winch, &QPlcSlaveNode::safeStateEntered);
    QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    master.safeStop("smoke");
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QCOMPARE(master.stateReason(), QString("smoke"));
    QCOMPARE(told.size(), 1);
    QCOMPARE(safe.size(), 1);
    QCOMPARE(winch.state(), QPlcSlaveNode::SafeStop);
    QTRY_COMPARE(winch.safeStates.load(), 1);
    QCOMPARE(winch.reason.load(), int(QPlcSlaveNode::MasterStopsSafely));
    const int steps = winch.steps;
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(master.waitForCycles(cycles + 10));  // they go on
    QCOMPARE(winch.steps.load(), steps);
    QCOMPARE(winch.safeStates.load(), 1);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    QCOMPARE(master.signalValue("count").toInt(), 0);
    QCOMPARE(stopped.size(), 0);
    QVERIFY(master.reset());
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY(master.stateReason().isEmpty());
    QCOMPARE(stopped.size(), 1);
    QCOMPARE(winch.state(), QPlcSlaveNode::Registered);
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(winch.steps > steps + 3);
    QVERIFY(master.signalValue("echo").toReal() >= 1.0);
    master.stop();
    QCOMPARE(winch.safeStates.load(), 2);
    QCOMPARE(winch.reason.load(), int(QPlcSlaveNode::PhaseEnded));
}

void tst_SafeStop::onlyAResetLeavesTheSafeStop()
{
    TestMaster master(QPlcClock::realTime());
    master.setCycleLimit(50);
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(2));
    master.safeStop("smoke");
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    for (bool (QPlcMasterNode::*request)() :
         {&QPlcMasterNode::initializeAllStates, &QPlcMasterNode::startRealTime, &QPlcMasterNode::arm}) {
        QVERIFY(!(master.*request)());
        QCOMPARE(master.error(), QPlcMasterNode::StateError);
        QVERIFY2(master.errorString().contains("fault latched: smoke"), qPrintable(master.errorString()));
    }
    master.stop();
    master.safeStop("again");
    QVERIFY(master.waitForCycles(60));  // no end at the limit of the phase either
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QCOMPARE(master.stateReason(), QString("smoke"));
    QCOMPARE(states.size(), 0);
    QVERIFY(master.reset());
    QVERIFY(master.reset());  // may be said twice
}

void tst_SafeStop::allNodesGetTheSafeValuesOfTheTable()
{
    TestMaster master(QPlcClock::realTime(), safeTable());
    master.setTimeSignal("time");
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode reader("Reader");
    reader.table = safeTable();
    reader.inputs = QStringList{"echo", "count", "setpoint", "free", "time"};
    reader.outputs = QStringList{"sum"};
    reader.answerAll();
    ScriptedNode writer("Writer");
    writer.table = safeTable();
    writer.inputs.clear();
    writer.outputs = QStringList{"echo"};
    writer.initialValues = QPlcValue(7.0).toBytes();
    writer.answerAll();
    QVERIFY(reader.registerAt(master.serverPort()));
    QVERIFY(writer.registerAt(master.serverPort()));
    QVERIFY(master.setSignalValue("setpoint", 5.0));
    QVERIFY(master.setSignalValue("free", 6.0));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("echo").toReal(), 7.0);
    QTRY_VERIFY(!reader.requests.isEmpty());
    for (const ScriptedNode::Request &request : qAsConst(reader.requests))
        QCOMPARE(int(request.flags), 0);
    master.safeStop();
    QTRY_COMPARE(int(reader.requests.last().flags), int(SafeStopFlag));  // requests from before may still wait
    const quint64 cycle = reader.requests.last().cycle;
    QTRY_VERIFY(reader.requests.last().cycle >= cycle + 5);
    const ScriptedNode::Request last = reader.requests.last();
    QCOMPARE(int(last.flags), int(SafeStopFlag));
    const auto real = [](const QByteArray &bytes) {
        return QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), bytes).toReal();
    };
    QCOMPARE(real(last.payload.mid(0, 8)), 0.25);  // `safe`
    QCOMPARE(real(last.payload.mid(12, 8)),
             -2.0);  // nobody's, but it has `safe`: the old setpoint moves nothing after the reset
    QCOMPARE(master.signalValue("free").toReal(), 6.0);  // nobody's, without `safe`
    QCOMPARE(master.signalValue("sum").toReal(), 0.0);
    QVERIFY(master.signalValue("time").isValid());
    // The answers of nodes count for nothing.
    writer.initialValues = QPlcValue(8.0).toBytes();
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    QCOMPARE(master.signalValue("echo").toReal(), 0.25);
    // The first frame with the flag is the first one with safe values.
    for (const ScriptedNode::Request &request : qAsConst(reader.requests))
        QCOMPARE(request.flags == SafeStopFlag, real(request.payload.mid(0, 8)) == 0.25);
    QVERIFY(master.reset());
    QVERIFY(reader.waitForMessage(QPlcMessage::RealTimeStopped));
}

void tst_SafeStop::answersDuringASafeStopAreIgnored()
{
    TestMaster master(QPlcClock::realTime(), safeTable());
    master.setInterval(0.05);
    QVERIFY(master.listen());
    ScriptedNode writer("Writer");
    writer.table = safeTable();
    writer.inputs.clear();
    writer.initialValues = QPlcValue(9.0).toBytes();
    writer.answerAll();
    QVERIFY(writer.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(2));  // the initial values are there before the first cycle
    QTRY_COMPARE(master.signalValue("echo").toReal(), 9.0);
    master.safeStop();
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.25);
    const quint64 cycles = master.statistics().cycles;
    int others = 0;
    QVERIFY(waitUntil(
        [&] {
            others += master.signalValue("echo").toReal() == 0.25 ? 0 : 1;
            return master.statistics().cycles >= cycles + 10;
        },
        10000));
    QCOMPARE(others, 0);
    QVERIFY(master.reset());
}

void tst_SafeStop::valuesComputedBeforeTheSafeStopAreIgnored()
{
    TestMaster master(QPlcClock::realTime(), safeTable());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    EarlyNode node;
    QVERIFY(master.addLocalNode(&node));
    ScriptedNode reader("Reader");
    reader.table = safeTable();
    reader.inputs = QStringList{"echo"};
    reader.outputs.clear();
    reader.initialValues.clear();
    reader.answerAll();
    QVERIFY(registerOrdered(reader, master.serverPort(), false, true));  // it reads values of the same cycle
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("echo").toReal(), 9.0);
    QVERIFY(reader.waitForRequests(3));
    master.safeStop();
    QTRY_COMPARE(int(reader.requests.last().flags), int(SafeStopFlag));
    for (const ScriptedNode::Request &request : qAsConst(reader.requests)) {
        if (request.flags == SafeStopFlag)
            QCOMPARE(request.payload.left(8), QPlcValue(0.25).toBytes());
    }
    QVERIFY(master.reset());
}

void tst_SafeStop::leasedSignalsBecomeSafeToo()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedTool person;
    QVERIFY(person.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QCOMPARE(person.next().kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(person.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}, {"timeout", 3600e9}}).kind(),
             QPlcMessage::Done);
    const QJsonObject four{{"values", QJsonObject{{"setpoint", "4"}}}};
    QCOMPARE(person.ask(QPlcMessage::SetSignals, four).kind(), QPlcMessage::Done);
    QTRY_COMPARE(master.signalValue("setpoint").toReal(), 4.0);
    master.safeStop();
    QTRY_COMPARE(master.signalValue("setpoint").toReal(), 0.0);
    (void)person.ask(QPlcMessage::SetSignals, four);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 3));
    QCOMPARE(master.signalValue("setpoint").toReal(), 0.0);
}

void tst_SafeStop::nodesOfEveryTransportAreSafe_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
    QTest::newRow("in process") << "local";
}

void tst_SafeStop::nodesOfEveryTransportAreSafe()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, kind));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(winch.steps > 3);
    master.safeStop();
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::SafeStop);
    QTRY_COMPARE(master.nodes().at(0).state, QString("SafeStop"));
    QTRY_COMPARE(winch.safeStates.load(), 1);
    QVERIFY(master.reset());
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Registered);
    QCOMPARE(winch.safeStates.load(), 1);
    winch.disconnectFromMaster();
}

void tst_SafeStop::lockstepKeepsItsPeriodDuringASafeStop()
{
    TestMaster master;
    master.setInterval(0.050);
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, "udp"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    master.safeStop();
    QTRY_COMPARE(winch.safeStates.load(), 1);
    const quint64 cycles = master.statistics().cycles;
    QElapsedTimer watch;
    watch.start();
    QVERIFY(master.waitForCycles(cycles + 4));
    QVERIFY(watch.elapsed() >= 100);  // at the pace of real time
    winch.disconnectFromMaster();
    QVERIFY(master.waitForCycles(cycles + 6));  // and for nobody it waits
}

void tst_SafeStop::listenersContinueAndMayJoinDuringASafeStop()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    QPlcSignalIndexTable::setCurrent(testTable());
    const auto hears = [](QPlcIOBufferSlaveNode &node) {
        return waitUntil([&] { return !node.takeInputSignals().isEmpty(); }, 10000);
    };
    QPlcIOBufferSlaveNode viewer("Viewer");
    viewer.setInputSignalIndices(indices({"echo"}));
    QVERIFY(viewer.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QVERIFY(hears(viewer));
    master.safeStop();
    QTRY_COMPARE(viewer.state(), QPlcSlaveNode::SafeStop);
    (void)viewer.takeInputSignals();
    QVERIFY(hears(viewer));
    QPlcIOBufferSlaveNode late("Late");
    late.setInputSignalIndices(indices({"echo"}));
    QVERIFY(late.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(hears(late));
    QTRY_COMPARE(late.state(), QPlcSlaveNode::SafeStop);
    QVERIFY(master.reset());
}

void tst_SafeStop::safeStopWithoutCyclesEndsSequencesAndLatchesNothing()
{
    TestMaster master;
    QVERIFY(master.listen());
    master.safeStop();
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    ScriptedNode node;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    master.safeStop();
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    node.playsAlong = false;
    QVERIFY(master.startRealTime());
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    master.safeStop("smoke");
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY(master.errorString().contains("smoke"));
}

void tst_SafeStop::controlChannelCarriesSafeStopAndReset()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::SafeStop).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::InitializeAllStates).kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::GetState).text("state"), QString("Ready"));
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::Reset, {{"latch", 0}}).text("error"), QString("WrongState"));
    QCOMPARE(tool.ask(QPlcMessage::SafeStop, {{"reason", "smoke\x1b[31m"}}).kind(), QPlcMessage::Done);
    const QPlcMessage state = tool.ask(QPlcMessage::GetState);
    QCOMPARE(state.text("state"), QString("SafeStop"));
    QVERIFY2(state.text("reason").startsWith("'Tool' asked for it: smoke"), qPrintable(state.text("reason")));
    QVERIFY(!state.text("reason").contains('\x1b'));
    QCOMPARE(state.fields().value("nodes").toArray().at(0).toObject().value("state").toString(), QString("SafeStop"));
    const QPlcMessage refused = tool.ask(QPlcMessage::StartRealTime);
    QCOMPARE(refused.text("error"), QString("WrongState"));
    QVERIFY2(refused.text("text").contains("fault latched: 'Tool' asked for it"), qPrintable(refused.text("text")));
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QCOMPARE(tool.ask(QPlcMessage::Reset, {{"latch", state.fields().value("latch")}}).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::GetState).text("state"), QString("Off"));
}

// Everybody may stop safely, and each State has the reason.
void tst_SafeStop::aLongReasonIsCut()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::InitializeAllStates).kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::SafeStop, {{"reason", QString(100000, 'x')}}).kind(), QPlcMessage::Done);
    const QPlcMessage state = tool.ask(QPlcMessage::GetState);
    QCOMPARE(state.text("state"), QString("SafeStop"));
    QCOMPARE(state.text("reason").count('x'), 1000);
}

void tst_SafeStop::aResetEndsOnlyTheSafeStopThatItsSenderHasSeen()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    const auto flyAndStop = [&] {
        master.startRealTime();
        const bool hasFlown = master.waitForState(QPlcMasterNode::RealTime);
        master.safeStop("smoke");
        return hasFlown && master.waitForState(QPlcMasterNode::SafeStop);
    };
    const auto latch = [&] {
        QPlcMessage answer = tool.ask(QPlcMessage::GetState);
        while (answer.kind() == QPlcMessage::StatesInitialized)
            answer = tool.next();  // news of the start
        return answer.fields().value("latch").toInt();
    };
    QCOMPARE(latch(), 0);
    QVERIFY(flyAndStop());
    QCOMPARE(latch(), 1);
    QVERIFY(master.reset() && flyAndStop());  // by somebody else
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    const QPlcMessage late = tool.ask(QPlcMessage::Reset, {{"latch", 1}});
    QCOMPARE(late.text("error"), QString("WrongState"));
    QVERIFY2(late.text("text").contains("(number 2: smoke)"), qPrintable(late.text("text")));
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QCOMPARE(tool.ask(QPlcMessage::Reset).text("error"), QString("MalformedMessage"));
    QCOMPARE(tool.ask(QPlcMessage::Reset, {{"latch", latch()}}).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(tool.ask(QPlcMessage::Reset, {{"latch", 1}}).kind(), QPlcMessage::Done);  // nothing is latched
    QCOMPARE(latch(), 2);
}

void tst_SafeStop::anArmedStartNeedsItsTokenAndReadiness()
{
    TestMaster master(QPlcClock::realTime());
    master.setArmingRequired(true);
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.addLocalNode(&winch));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::Arm).text("error"), QString("WrongState"));  // not initialized
    QVERIFY(!master.startRealTime());
    QVERIFY(master.errorString().contains("initialize, arm, then start"));
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    QVERIFY(!master.startRealTime());
    QVERIFY2(master.errorString().contains("not armed"), qPrintable(master.errorString()));
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime).text("error"), QString("WrongState"));

    const QPlcMessage first = tool.ask(QPlcMessage::Arm);
    QCOMPARE(first.kind(), QPlcMessage::Armed);
    QCOMPARE(first.fields().value("validFor").toDouble(), 5e9);
    QVERIFY(master.isArmed());
    const QPlcMessage second = tool.ask(QPlcMessage::Arm);
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime, {{"token", first.text("token")}}).text("error"),
             QString("WrongState"));
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime, {{"token", second.text("token")}}).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(!master.isArmed());
    QCOMPARE(tool.ask(QPlcMessage::Arm).text("error"), QString("WrongState"));
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);

    QVERIFY(master.initializeAllStates());  // a token of yesterday starts nothing
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime, {{"token", second.text("token")}}).text("error"),
             QString("WrongState"));
    QVERIFY(master.arm());
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));  // who joins makes it void
    QVERIFY(!master.isArmed());
    QVERIFY(!master.startRealTime());
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QVERIFY(master.arm());
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    master.stop();
}

QTEST_GUILESS_MAIN(tst_SafeStop)
#include "tst_SafeStop.moc"

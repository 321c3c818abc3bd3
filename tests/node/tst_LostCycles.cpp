// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "VirtualTime.h"
#include "protocol/LittleEndian.h"

// Each cycle of a phase is computed, or the node knows why not: it was lost on the way, or its
// master has not sent it. From the first cycle to the last one.
class tst_LostCycles : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent(testTable()); }
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void lostCyclesAndThoseNotSentAreToldApart();
    void cyclesLostBeforeTheFirstFrameCount();
    void cyclesLostAtTheEndCount();
    void aNodeThatGotNoFrameHasMissedAll();
    void anImpossibleEndCountsNothing_data();
    void anImpossibleEndCountsNothing();
    void moreCyclesNotSentThanThereAreCountAsAll();
    void aListenerTakesFramesThatTheStopHasOvertaken();
    void otherNodesComputeNothingAfterTheStop();
    void aListenerDoesNotWaitForFramesThatNeverCome();
    void answersTellTheCycleComputedBefore();
    void theMasterTellsHowManyCyclesItHasNotSent();
    void theMasterTellsTheLastCycleItHasSent();
    void aPhaseWithoutCyclesHasNoLastCycle();
    void aListenerHearsEveryCycleOfAPhase_data();
    void aListenerHearsEveryCycleOfAPhase();
};

namespace {

QVector<quint64> cyclesUpTo(quint64 end)
{
    QVector<quint64> cycles;
    for (quint64 cycle = 0; cycle < end; ++cycle)
        cycles << cycle;
    return cycles;
}

/// The end of a phase whose last frame was that of \a cycle.
QJsonObject endOf(const ScriptedMaster &master, qint64 cycle)
{
    return {{"reason", "over"},
            {"lastCycle", QPlcMessage::fromHex64(master.first + quint64(cycle))},
            {"before", double(master.before)}};
}

int beforeOf(const QByteArray &frame)
{
    return qplc::loadLittle<quint16>(frame.constData() + 10);
}

/// Lets \a listener, for which nobody waits, take part in the initialization.
bool initialize(TestMaster &master, ScriptedNode &listener)
{
    const bool isBegun = master.listen() && listener.registerAt(master.serverPort()) && master.initializeAllStates();
    const bool isDone = isBegun && listener.waitForMessage(QPlcMessage::InitializeWithValues);
    pass(std::chrono::milliseconds(10));  // its answer arrives
    return isDone && master.state() == QPlcMasterNode::Ready;
}

/// Waits until \a node is out of its phase.
bool hasEnded(const QPlcSlaveNode &node)
{
    return waitUntil([&] { return node.state() == QPlcSlaveNode::Off; });
}

}  // namespace

void tst_LostCycles::lostCyclesAndThoseNotSentAreToldApart()
{
    ScriptedMaster master;
    CounterNode node;
    QVector<quint64> missed;
    node.onStep = [&](const QPlcCycle &cycle) { missed << cycle.missedCycles(); };
    QVERIFY(master.beginWith(node));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    master.request(3);  // 1 and 2 are lost
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(node.counters().missed, quint64(2));
    QCOMPARE(node.counters().skipped, quint64(0));
    master.before = 2;
    master.request(6);  // 4 and 5 were not sent
    QVERIFY(master.waitForAnswers(3));
    QCOMPARE(node.counters().missed, quint64(2));
    QCOMPARE(node.counters().skipped, quint64(2));
    master.before = 3;
    master.request(10);  // of 7, 8 and 9, one was not sent
    QVERIFY(master.waitForAnswers(4));
    QCOMPARE(node.counters().missed, quint64(4));
    QCOMPARE(node.counters().skipped, quint64(3));
    master.before = 2;
    master.request(11 + 65535);  // 65535 were not sent: the count of 16 bits begins again
    QVERIFY(master.waitForAnswers(5));
    QCOMPARE(node.counters().missed, quint64(4));
    QCOMPARE(node.counters().skipped, quint64(3 + 65535));
    QCOMPARE(missed, (QVector<quint64>{0, 2, 2, 3, 65535}));  // for a model both are time that has passed
    node.disconnectFromMaster();
}

void tst_LostCycles::cyclesLostBeforeTheFirstFrameCount()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.before = 1;
    master.request(4);
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(node.counters().missed, quint64(3));
    QCOMPARE(node.counters().skipped, quint64(0));  // it was not there yet
    node.disconnectFromMaster();
}

void tst_LostCycles::cyclesLostAtTheEndCount()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    master.before = 1;
    master.send(QPlcMessage::RealTimeStopped, endOf(master, 5));
    QVERIFY(hasEnded(node));
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().missed, quint64(4));  // of 1 to 5, one was not sent
}

void tst_LostCycles::aNodeThatGotNoFrameHasMissedAll()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.before = 3;
    master.send(QPlcMessage::RealTimeStopped, endOf(master, 9));
    QVERIFY(hasEnded(node));
    QCOMPARE(node.counters().missed, quint64(7));
}

void tst_LostCycles::anImpossibleEndCountsNothing_data()
{
    QTest::addColumn<int>("computed");
    QTest::addColumn<qint64>("last");
    QTest::newRow("before the first cycle") << 3 << qint64(-1);
    QTest::newRow("a cycle that was computed") << 3 << qint64(2);
    QTest::newRow("before that") << 3 << qint64(1);
    QTest::newRow("before the first cycle, and nothing came") << 0 << qint64(-2);
}

void tst_LostCycles::anImpossibleEndCountsNothing()
{
    QFETCH(int, computed);
    QFETCH(qint64, last);
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    for (int cycle = 0; cycle < computed; ++cycle)
        master.request(quint64(cycle));
    QVERIFY(master.waitForAnswers(computed));
    master.send(QPlcMessage::RealTimeStopped, endOf(master, last));
    QVERIFY(hasEnded(node));
    QCOMPARE(node.counters().missed, quint64(0));
}

void tst_LostCycles::moreCyclesNotSentThanThereAreCountAsAll()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(0);
    master.before = 1000;
    master.request(3);
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(node.counters().missed, quint64(0));
    QCOMPARE(node.counters().skipped, quint64(2));
    node.disconnectFromMaster();
}

void tst_LostCycles::aListenerTakesFramesThatTheStopHasOvertaken()
{
    ScriptedMaster master;
    CountListener listener;
    QVERIFY(master.beginWith(listener));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    master.send(QPlcMessage::RealTimeStopped, endOf(master, 5));
    for (const quint64 cycle : {1, 2, 3, 4, 5})
        master.request(cycle);
    QVERIFY(hasEnded(listener));
    QCOMPARE(listener.takeCycles(), cyclesUpTo(6));
    QCOMPARE(listener.counters().missed, quint64(0));
}

void tst_LostCycles::otherNodesComputeNothingAfterTheStop()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    master.send(QPlcMessage::RealTimeStopped, endOf(master, 3));
    QVERIFY(hasEnded(node));
    for (const quint64 cycle : {1, 2, 3})
        master.request(cycle);
    pass(std::chrono::milliseconds(100));
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().missed, quint64(3));
}

void tst_LostCycles::aListenerDoesNotWaitForFramesThatNeverCome()
{
    ScriptedMaster master;
    CountListener listener;
    QVERIFY(master.beginWith(listener));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    const qint64 begin = qplc::monotonicNow();
    master.send(QPlcMessage::RealTimeStopped, endOf(master, 100));
    QVERIFY(hasEnded(listener));
    QVERIFY(qplc::monotonicNow() - begin < 200'000'000);  // [ns] of virtual time
    QCOMPARE(listener.counters().missed, quint64(100));
}

void tst_LostCycles::answersTellTheCycleComputedBefore()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(2);
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(beforeOf(master.answers.at(0).bytes), 0);  // the first one of the phase
    master.request(5);
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(beforeOf(master.answers.at(1).bytes), 3);
    master.request(5, qplc::ResentFlag);
    QVERIFY(master.waitForAnswers(3));
    QCOMPARE(beforeOf(master.answers.at(2).bytes), 3);
    master.request(6);
    QVERIFY(master.waitForAnswers(4));
    QCOMPARE(beforeOf(master.answers.at(3).bytes), 1);
    master.request(6 + 65535);
    QVERIFY(master.waitForAnswers(5));
    QCOMPARE(beforeOf(master.answers.at(4).bytes), 65535);
    master.request(6 + 65535 + 65536);
    QVERIFY(master.waitForAnswers(6));
    QCOMPARE(beforeOf(master.answers.at(5).bytes), 65535);  // or more
    node.disconnectFromMaster();
}

void tst_LostCycles::theMasterTellsHowManyCyclesItHasNotSent()
{
    TestMaster master;
    CounterNode counter;
    ScriptedNode node;
    node.onlyListen();
    node.every = 3;
    QVERIFY(master.addLocalNode(&counter));
    master.setCycleLimit(9);
    QVERIFY(initialize(master, node) && master.startRealTime());
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));
    QVERIFY(node.waitForRequests(3));
    for (int i = 0; i < 3; ++i)
        QCOMPARE(beforeOf(node.requests.at(i).bytes), 2 * i);
}

void tst_LostCycles::theMasterTellsTheLastCycleItHasSent()
{
    TestMaster master;
    ScriptedNode node;
    node.answerAll();
    master.setCycleLimit(7);
    QVERIFY(node.beginWith(master));
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));
    const QPlcMessage stop = node.messages.last();
    QCOMPARE(stop.hex64("lastCycle"), node.requests.last().cycle);
    QCOMPARE(node.requests.size(), 7);
    QVERIFY(!stop.fields().contains("before"));  // none was left out
}

void tst_LostCycles::aPhaseWithoutCyclesHasNoLastCycle()
{
    TestMaster master;
    ScriptedNode node;
    ScriptedNode stopped(QStringLiteral("Stopped"));
    stopped.outputs.clear();
    stopped.initialValues.clear();
    QVERIFY(master.listen() && node.registerAt(master.serverPort()) && stopped.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates() && master.waitForState(QPlcMasterNode::Ready));
    stopped.playsAlong = false;  // it never gets ready
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStarted));
    master.stop();
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));
    QVERIFY(!node.messages.last().fields().contains("lastCycle"));
}

void tst_LostCycles::aListenerHearsEveryCycleOfAPhase_data()
{
    QTest::addColumn<bool>("isLate");
    QTest::newRow("ready at the start") << false;
    QTest::newRow("ready when cycles run") << true;
}

void tst_LostCycles::aListenerHearsEveryCycleOfAPhase()
{
    QFETCH(bool, isLate);
    constexpr int cycles = 50;
    TestMaster master;
    CounterNode counter;
    ScriptedNode listener;
    listener.onlyListen();
    QVERIFY(master.addLocalNode(&counter));
    master.setCycleLimit(cycles);
    QVERIFY(initialize(master, listener));
    listener.playsAlong = !isLate;
    QVERIFY(master.startRealTime());
    QVERIFY(listener.waitForMessage(QPlcMessage::RealTimeStopped));
    QVERIFY(listener.waitForFrames(cycles));
    const quint64 zero = listener.messages.at(listener.messages.size() - 2).hex64("cycleZero");
    QCOMPARE(listener.frames.size(), cycles);
    QCOMPARE(listener.messages.last().hex64("lastCycle"), zero + cycles - 1);
    for (int i = 0; i < cycles; ++i) {
        QCOMPARE(listener.frames.at(i).cycle, zero + quint64(i));
        QCOMPARE(beforeOf(listener.frames.at(i).bytes), 0);
    }
}

QTPLC_VIRTUAL_TIME_MAIN(tst_LostCycles)
#include "tst_LostCycles.moc"

// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ScriptedNode.h"

// Nodes in the process of the master, clocks, and the signals that the master writes.
class tst_LocalNodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theOrderOfTheNodesDoesNotMatter();
    void aRemovedNodeLeavesAndStopsThePlant();
    void everyPhaseStartsFromTheInitialStates();
    void theCycleLimitIsExact_data();
    void theCycleLimitIsExact();
    void lockstepTimeIsExact();
    void realTimeFollowsTheWallClock();
    void aScaledClockRunsScaled();
    void masterMeasuresJitterAndWorkload();
    void aNodeMayBeAddedAgain();
    void destroyingARunningMasterStopsIt();
    void nodeMayBeRemovedInItsOwnSignalHandler_data();
    void nodeMayBeRemovedInItsOwnSignalHandler();
    void signalHandlerMayStopAStart_data();
    void signalHandlerMayStopAStart();
    void aCriticalNodeMayLeaveAfterAStartThatFailed();
    void aNodeThatEndsBeforeItsMasterLeavesIt_data();
    void aNodeThatEndsBeforeItsMasterLeavesIt();
    void unreadEventsDelayNoCycle();
    void leaseEndsWhileTheEventLoopHangs();
};

void tst_LocalNodes::theOrderOfTheNodesDoesNotMatter()
{
    QVector<quint64> digests;
    for (bool echoFirst : {true, false}) {
        TestMaster master;
        CounterNode counter;
        EchoNode echo;
        QVERIFY(echoFirst ? master.addLocalNode(&echo) && master.addLocalNode(&counter)
                          : master.addLocalNode(&counter) && master.addLocalNode(&echo));
        master.setCycleLimit(1000);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        digests << master.statistics().imageDigest;
        // The echo of cycle k is the count of cycle k - 1: one cycle of dead time per link.
        QCOMPARE(master.signalValue("echo").toReal(), 999.0);
    }
    QCOMPARE(digests.at(0), digests.at(1));
    QVERIFY(digests.at(0) != 0);
}

void tst_LocalNodes::aRemovedNodeLeavesAndStopsThePlant()
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    master.removeLocalNode(&echo);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(echo.state(), QPlcSlaveNode::Disconnected);
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(master.writer("echo"), QString());
    QCOMPARE(counter.stops, 1);
    QVERIFY(master.setSignalValue("echo", 2.0));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    master.stop();
    EchoNode stranger;
    master.removeLocalNode(&stranger);  // nothing to remove
    QCOMPARE(master.nodes().size(), 1);
}

void tst_LocalNodes::everyPhaseStartsFromTheInitialStates()
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.addLocalNode(&echo));
    master.setCycleLimit(100);
    quint64 digest = 0;
    for (int phase = 1; phase <= 5; ++phase) {
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(counter.resets, phase);
        QCOMPARE(counter.initializations, phase);
        QCOMPARE(counter.stops, phase);
        QCOMPARE(counter.lastCycle, quint64(99));
        QCOMPARE(master.signalValue("count").toInt(), 100);
        digest = phase == 1 ? master.statistics().imageDigest : digest;
        QCOMPARE(master.statistics().imageDigest, digest);
    }
}

void tst_LocalNodes::theCycleLimitIsExact_data()
{
    QTest::addColumn<quint64>("limit");
    for (quint64 limit : {1, 2, 999, 100000})
        QTest::addRow("%llu", limit) << limit;
}

void tst_LocalNodes::theCycleLimitIsExact()
{
    QFETCH(quint64, limit);
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    master.setCycleLimit(limit);
    QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(stopped.size(), 1);
    QCOMPARE(master.statistics().cycles, limit);
    QCOMPARE(master.cycle(), limit - 1);
    QCOMPARE(master.signalValue("count").toUInt64(), limit);
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
}

void tst_LocalNodes::lockstepTimeIsExact()
{
    TestMaster master;
    master.setInterval(std::chrono::nanoseconds(3'333'333));
    QVERIFY(master.setTimeSignal("time"));
    QVERIFY(master.activateJitterMeasurement("jitter"));
    QVERIFY(master.activateWorkloadMeasurement("masterWorkload"));
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    master.setCycleLimit(10001);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("time").toInt64(), qint64(10000) * 3'333'333);
    QCOMPARE(master.signalValue("jitter").toReal(), 0.0);
    QCOMPARE(master.signalValue("masterWorkload").toReal(), 0.0);
}

void tst_LocalNodes::realTimeFollowsTheWallClock()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    QVERIFY(master.setTimeSignal("time"));
    const QDateTime before = QDateTime::currentDateTimeUtc();
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(10));
    master.stop();
    const QDateTime time = master.signalValue("time").toDateTime();
    QVERIFY(time >= before.addMSecs(-1));
    QVERIFY(time <= QDateTime::currentDateTimeUtc());
}

void tst_LocalNodes::aScaledClockRunsScaled()
{
    TestMaster master(QPlcClock::scaled(100.0));
    master.setInterval(0.1);  // a cycle each millisecond
    CounterNode counter;
    QVector<qint64> periods;
    counter.onStep = [&](const QPlcCycle &cycle) { periods << cycle.period().count(); };
    QVERIFY(master.addLocalNode(&counter));
    QElapsedTimer timer;
    timer.start();
    QVERIFY(master.startRealTime());
    QVERIFY(waitUntil([&] { return master.cycle() >= 30; }, 10000));
    QVERIFY(timer.elapsed() >= 29);   // not faster than said
    QVERIFY(timer.elapsed() < 2900);  // and not in real time
    master.stop();
    QCOMPARE(periods.at(0), qint64(100'000'000));  // nodes see simulated time
}

void tst_LocalNodes::masterMeasuresJitterAndWorkload()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    QVERIFY(master.activateJitterMeasurement("jitter"));
    QVERIFY(master.activateWorkloadMeasurement("masterWorkload"));
    CounterNode counter;
    counter.activateWorkloadMeasurement("workload");
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    master.stop();
    QVERIFY(master.signalValue("masterWorkload").toReal() > 0.0);
    QVERIFY(master.signalValue("workload").toReal() > 0.0);
    QVERIFY(master.signalValue("jitter").toReal() > 0.0);
    QVERIFY(master.signalValue("jitter").toReal() < 0.002);
    const QPlcMasterStatistics statistics = master.statistics();
    QVERIFY(statistics.latenessMedian <= statistics.lateness99 && statistics.lateness99 <= statistics.latenessMaximum);
}

void tst_LocalNodes::aNodeMayBeAddedAgain()
{
    TestMaster first;
    TestMaster second;
    EchoNode echo;
    QVERIFY(first.addLocalNode(&echo));
    QVERIFY(!first.addLocalNode(&echo));
    first.removeLocalNode(&echo);
    QVERIFY(second.addLocalNode(&echo));
    QVERIFY(second.startRealTime());
    QVERIFY(second.waitForCycles(3));
    second.stop();
}

void tst_LocalNodes::destroyingARunningMasterStopsIt()
{
    CounterNode counter;
    {
        TestMaster master;
        QVERIFY(master.addLocalNode(&counter));
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForCycles(3));
    }
    QCOMPARE(counter.stops, 1);
}

void tst_LocalNodes::nodeMayBeRemovedInItsOwnSignalHandler_data()
{
    QTest::addColumn<QPlcSlaveNode::State>("state");
    QTest::newRow("outputs are wanted") << QPlcSlaveNode::Initializing;
    QTest::newRow("inputs have come") << QPlcSlaveNode::Ready;
    QTest::newRow("the phase has begun") << QPlcSlaveNode::RealTime;
}

void tst_LocalNodes::nodeMayBeRemovedInItsOwnSignalHandler()
{
    QFETCH(QPlcSlaveNode::State, state);
    TestMaster master;
    EchoNode echo;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&echo) && master.addLocalNode(&counter));
    bool isRemoved = false;
    connect(&echo, &QPlcSlaveNode::stateChanged, &master, [&] {
        if (!isRemoved && echo.state() == state) {
            isRemoved = true;
            master.removeLocalNode(&echo);
        }
    });
    master.startRealTime();
    QVERIFY(isRemoved);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(echo.state(), QPlcSlaveNode::Disconnected);
    QCOMPARE(counter.state(), QPlcSlaveNode::Registered);
    QCOMPARE(master.nodes().size(), 1);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(counter.state(), QPlcSlaveNode::RealTime);
    master.stop();
}

void tst_LocalNodes::signalHandlerMayStopAStart_data()
{
    QTest::addColumn<bool>("isInitialization");
    QTest::newRow("states are initialized") << true;
    QTest::newRow("cycles run") << false;
}

void tst_LocalNodes::signalHandlerMayStopAStart()
{
    QFETCH(bool, isInitialization);
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    if (isInitialization)
        connect(&master, &QPlcMasterNode::statesInitialized, &master, [&] { master.stop(); });
    else
        connect(&master, &QPlcMasterNode::stateChanged, &master, [&] {
            if (master.state() == QPlcMasterNode::RealTime)
                master.stop();
        });
    QSignalSpy started(&master, &QPlcMasterNode::realTimeHasStarted);
    master.startRealTime();
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(counter.state(), QPlcSlaveNode::Registered);
    QCOMPARE(started.size(), 0);
}

void tst_LocalNodes::aCriticalNodeMayLeaveAfterAStartThatFailed()
{
    LogCapture log;
    TestMaster master;
    CounterNode counter;
    counter.setCritical(true);
    ScriptedNode other;
    QVERIFY(master.listen() && master.addLocalNode(&counter) && other.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates() && master.waitForState(QPlcMasterNode::Ready));
    other.playsAlong = false;
    QVERIFY(master.startRealTime());  // the node here is ready at once, the other one never
    QVERIFY(other.waitForMessage(QPlcMessage::RealTimeStarted));
    other.control.abort();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const QSignalSpy errors(&master, &QPlcMasterNode::errorOccurred);
    master.removeLocalNode(&counter);
    QCOMPARE(errors.size(), 0);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_LocalNodes::aNodeThatEndsBeforeItsMasterLeavesIt_data()
{
    QTest::addColumn<bool>("isInitializing");
    QTest::newRow("while the master is off") << false;
    QTest::newRow("while a sequence waits for another node") << true;
}

void tst_LocalNodes::aNodeThatEndsBeforeItsMasterLeavesIt()
{
    QFETCH(bool, isInitializing);
    TestMaster master;
    EchoNode echo;
    ScriptedNode silent(QStringLiteral("Silent"));
    silent.playsAlong = false;
    silent.outputs.clear();
    silent.initialValues.clear();
    {
        CounterNode counter;
        QVERIFY(master.addLocalNode(&counter));
        QVERIFY(master.addLocalNode(&echo));
        QVERIFY(master.listen());
        QVERIFY(silent.registerAt(master.serverPort()));
        if (isInitializing) {
            QVERIFY(master.initializeAllStates());
            QCOMPARE(master.state(), QPlcMasterNode::Initializing);
        }
    }
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(master.nodes().size(), 2);
    QCOMPARE(master.writer("count"), QString());
}

/// As when the event loop hangs: nobody takes what the cycles have to tell, which is far more than
/// there is room for.
void tst_LocalNodes::unreadEventsDelayNoCycle()
{
    constexpr quint64 cycles = 10'000;
    class Babbler : public QPlcCompactSlaveNode
    {
    public:
        Babbler()
            : QPlcCompactSlaveNode("Babbler")
        {
        }
        void step(const QPlcCycle &cycle) override { m_echo = cycle.number() % 2 == 0 ? qQNaN() : 1.0; }
        QPlcOutput<double> m_echo{this, "echo"};
    } babbler;
    const LogCapture log;
    TestMaster master;
    QVERIFY(master.addLocalNode(&babbler));
    QVERIFY(master.startRealTime());
    const QDeadlineTimer deadline(10'000);
    while (master.statistics().cycles < cycles && !deadline.hasExpired())
        QThread::msleep(1);  // without a look at events
    QVERIFY(master.statistics().cycles >= cycles);
    master.stop();
}

void tst_LocalNodes::leaseEndsWhileTheEventLoopHangs()
{
    TestMaster master(QPlcClock::realTime());
    EchoNode echo;
    master.setInterval(0.002);
    QVERIFY(master.listen() && master.addLocalNode(&echo));
    ScriptedTool anna("Anna");
    QVERIFY(anna.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime() && anna.waitForMessage(QPlcMessage::StatesInitialized));
    anna.forgetMessages();
    const QJsonObject values{{"echo", "-1.5"}};
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"echo"}}, {"values", values}, {"timeout", 500e6}})
                 .kind(),
             QPlcMessage::Done);
    QTRY_COMPARE(master.signalValue("echo").toReal(), -1.5);
    anna.send(QPlcMessage::GetState);  // arrives in time, and is not read in time
    const QDeadlineTimer deadline(20'000);
    while (master.signalValue("echo").toReal() != 0.0 && !deadline.hasExpired())
        QThread::msleep(1);  // without a look at events
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    QCOMPARE(anna.next().kind(), QPlcMessage::State);
    QVERIFY(master.leases().at(0).isLost);
    QCOMPARE(anna.ask(QPlcMessage::SetSignals, {{"values", values}}).text("error"), QString("LeaseHeld"));
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    master.stop();
}

QTEST_GUILESS_MAIN(tst_LocalNodes)
#include "tst_LocalNodes.moc"

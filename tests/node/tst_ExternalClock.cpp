// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "Stepping.h"

#include <stdexcept>

// The program turns the clock: each cycle is a call of step().
class tst_ExternalClock : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }

    void eachStepIsACycle();
    void withoutACycleToComputeAStepIsStopped();
    void theCycleLimitEndsThePhase();
    void resultsAreThoseOfLockstep_data();
    void resultsAreThoseOfLockstep();
    void aPortHasTheValueOfItsDelay_data();
    void aPortHasTheValueOfItsDelay();
    void aFailedLocalNodeIsKnownWhenTheStepReturns();
    void theStepInWhichANodeFailsEndsThePhase_data();
    void theStepInWhichANodeFailsEndsThePhase();
    void aFailedListenerElsewhereEndsNothing();

    void aSecondCallerIsRefused();
    void stopEndsTheStep();
    void stopBetweenStepsEndsThePhase();
    void phasesFollowEachOther();
    void aNodeThatHangsCostsTheLimitOnce();
    void aNodeThatHangsMayStopThePlant_data();
    void aNodeThatHangsMayStopThePlant();
    void aLostNodeMakesTheStepLate();
    void aNodeLostBetweenStepsMakesTheNextOneLate_data();
    void aNodeLostBetweenStepsMakesTheNextOneLate();
    void aLostCriticalNodeStopsThePlantSafely();

    void safeStopReachesNodesWithoutSteps();
    void aLeaseEndsBetweenSteps();
    void aHostThatHangsStopsDevicesOnly();
    void devicesCannotBeLocal();
};

void tst_ExternalClock::eachStepIsACycle()
{
    External master;
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    for (int cycle = 0; cycle < 10; ++cycle) {
        QCOMPARE(master.step(), StepResult::Complete);
        QCOMPARE(master.cycle(), quint64(cycle));
        QCOMPARE(counter.count(), cycle + 1);
    }
    pass(20ms);
    QCOMPARE(master.statistics().cycles, quint64(10));  // nothing else turns the clock
    master.stop();
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_ExternalClock::withoutACycleToComputeAStepIsStopped()
{
    QPlcMasterNode nothing;
    QCOMPARE(nothing.step(), StepResult::Stopped);
    TestMaster lockstep;
    CounterNode counter;
    QVERIFY(lockstep.addLocalNode(&counter));
    QVERIFY(lockstep.startRealTime());
    QCOMPARE(lockstep.step(), StepResult::Stopped);
    lockstep.stop();
    External master;
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));
    QCOMPARE(master.step(), StepResult::Stopped);
    QVERIFY(master.startRealTime());
    QCOMPARE(master.step(), StepResult::Complete);
    master.stop();
    QCOMPARE(master.step(), StepResult::Stopped);
    QCOMPARE(other.count(), 1);
}

void tst_ExternalClock::theCycleLimitEndsThePhase()
{
    External master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    master.setCycleLimit(3);
    QVERIFY(master.startRealTime());
    for (int cycle = 0; cycle < 3; ++cycle)
        QCOMPARE(master.step(), StepResult::Complete);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(master.step(), StepResult::Stopped);
    QCOMPARE(counter.count(), 3);
}

void tst_ExternalClock::resultsAreThoseOfLockstep_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"local", "udp", "tcp", "shared", "multicast"})
        QTest::newRow(kind) << kind;
}

void tst_ExternalClock::resultsAreThoseOfLockstep()
{
    QFETCH(QString, kind);
    constexpr quint64 cycles = 500;
    QVector<quint64> digests;
    for (const QPlcClock clock : {QPlcClock::lockstep(), QPlcClock::external()}) {
        TestMaster master(clock);
        master.setLongestWait(20s);
        master.setCycleLimit(cycles);
        master.setMulticastGroup(QHostAddress("239.255.76.69"));
        QVERIFY(master.setTimeSignal("time") && master.activateJitterMeasurement("jitter")
                && master.activateWorkloadMeasurement("masterWorkload"));
        QVERIFY(master.listen());
        CounterNode counter;
        EchoNode echo;
        echo.activateWorkloadMeasurement("workload");
        const quint16 port = master.serverPort();
        for (QPlcSlaveNode *node : {static_cast<QPlcSlaveNode *>(&counter), static_cast<QPlcSlaveNode *>(&echo)}) {
            const auto protocol = kind == "shared" ? QPlcUnderlyingProtocol::local(QString::number(port))
                : kind == "multicast"              ? QPlcUnderlyingProtocol::udpMulticast(QHostAddress::LocalHost, port)
                                                   : QPlcUnderlyingProtocol();
            const bool isIn
                = protocol.isValid() ? node->connectToMasterAndWaitForConnected(protocol) : master.admit(*node, kind);
            QVERIFY2(isIn, qPrintable(node->errorString() + master.errorString()));
        }
        QVERIFY(master.startRealTime());
        if (clock.isExternal()) {
            QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
            for (quint64 cycle = 0; cycle < cycles; ++cycle)
                QCOMPARE(master.step(), StepResult::Complete);
        }
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.statistics().cycles, cycles);
        QCOMPARE(master.statistics().lateAnswers, quint64(0));
        digests << master.statistics().imageDigest;
    }
    QCOMPARE(digests.at(1), digests.at(0));
    QVERIFY(digests.at(0) != 0);
}

namespace {

class Writer : public QPlcCompactSlaveNode
{
public:
    Writer()
        : QPlcCompactSlaveNode("Writer")
    {
    }
    QPlcOutput<double> value{this, "setpoint"};
    void step(const QPlcCycle &) override {}
};

class Reader : public QPlcCompactSlaveNode
{
public:
    explicit Reader(QPlcInputTiming::Value timing)
        : QPlcCompactSlaveNode("Reader")
        , value{this, "echo", timing}
    {
    }
    QPlcInput<double> value;
    void step(const QPlcCycle &) override {}
};

class Copy : public QPlcCompactSlaveNode
{
public:
    explicit Copy(QPlcInputTiming::Value timing)
        : QPlcCompactSlaveNode("Copy")
        , m_setpoint{this, "setpoint", timing}
    {
    }
    void step(const QPlcCycle &) override { m_echo = m_setpoint + 0.0; }

private:
    QPlcInput<double> m_setpoint;
    QPlcOutput<double> m_echo{this, "echo"};
};

}  // namespace

void tst_ExternalClock::aPortHasTheValueOfItsDelay_data()
{
    QTest::addColumn<bool>("plantReadsSame");
    QTest::addColumn<bool>("hostReadsSame");
    QTest::addColumn<int>("delay");
    QTest::newRow("default") << false << false << 2;
    QTest::newRow("plant reads in the same cycle") << true << false << 1;
    QTest::newRow("host reads in the same cycle") << false << true << 1;
    QTest::newRow("both") << true << true << 0;
}

void tst_ExternalClock::aPortHasTheValueOfItsDelay()
{
    QFETCH(bool, plantReadsSame);
    QFETCH(bool, hostReadsSame);
    QFETCH(int, delay);
    const auto timing = [](bool same) { return same ? QPlcInputTiming::SameCycle : QPlcInputTiming::LastCycle; };
    External master;
    Writer writer;
    Copy plant(timing(plantReadsSame));
    Reader reader(timing(hostReadsSame));
    QVERIFY(master.addLocalNode(&reader) && master.addLocalNode(&plant) && master.addLocalNode(&writer));
    QVERIFY(master.startRealTime());
    const auto given = [](int cycle) { return 0.25 * (cycle + 1); };
    for (int cycle = 0; cycle < 8; ++cycle) {
        writer.value = given(cycle);
        QCOMPARE(master.step(), StepResult::Complete);
        QCOMPARE(double(reader.value), cycle >= delay ? given(cycle - delay) : 0.0);
        const int age = plantReadsSame ? 0 : 1;
        QCOMPARE(master.signalValue("echo").toReal(), cycle >= age ? given(cycle - age) : 0.0);
    }
    master.stop();
}

void tst_ExternalClock::aFailedLocalNodeIsKnownWhenTheStepReturns()
{
    External master;
    CounterNode counter;
    counter.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 1)
            throw std::runtime_error("no more");
    };
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.startRealTime());
    QCOMPARE(master.step(), StepResult::Complete);
    QCOMPARE(master.step(), StepResult::Stopped);
    QCOMPARE(master.state(), QPlcMasterNode::Off);  // without a look at events
    QVERIFY2(master.errorString().contains("no more"), qPrintable(master.errorString()));
    QCOMPARE(master.step(), StepResult::Stopped);
}

void tst_ExternalClock::theStepInWhichANodeFailsEndsThePhase_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("isCritical");
    QTest::addColumn<StepResult>("result");
    for (const char *kind : {"local", "udp", "tcp", "shared"}) {
        QTest::addRow("%s", kind) << kind << false << StepResult::Stopped;
        QTest::addRow("%s, critical", kind) << kind << true << StepResult::SafeStop;
    }
}

/// The thread of the master has heard nothing of it yet.
void tst_ExternalClock::theStepInWhichANodeFailsEndsThePhase()
{
    QFETCH(QString, kind);
    QFETCH(bool, isCritical);
    QFETCH(StepResult, result);
    External master;
    EchoNode echo;
    echo.setCritical(isCritical);
    echo.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 1)
            throw std::runtime_error("no more");
    };
    QVERIFY(master.listen());
    const auto shared = QPlcUnderlyingProtocol::local(QString::number(master.serverPort()));
    QVERIFY(kind == "shared" ? echo.connectToMasterAndWaitForConnected(shared) : master.admit(echo, kind));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    QCOMPARE(Host(master).resultWithoutEvents(), result);
    QCOMPARE(Host(master).resultWithoutEvents(), result);
    QCOMPARE(master.statistics().cycles, quint64(2));
    QVERIFY(master.waitForState(isCritical ? QPlcMasterNode::SafeStop : QPlcMasterNode::Off));
    QVERIFY2(master.errorString().contains("Echo"), qPrintable(master.errorString()));
}

void tst_ExternalClock::aFailedListenerElsewhereEndsNothing()
{
    External master;
    CounterNode counter;
    EchoNode listener("Listener");
    listener.setListener(true);
    std::atomic<bool> hasFailed{false};
    listener.onStep = [&](const QPlcCycle &) {
        hasFailed = true;
        throw std::runtime_error("no more");
    };
    QVERIFY(master.listen() && master.addLocalNode(&counter) && master.admit(listener, "tcp"));
    QVERIFY(master.begin());
    for (int i = 0; i < 10'000 && !hasFailed; ++i)
        QCOMPARE(stepAside(master), StepResult::Complete);
    QVERIFY(waitUntil([&] { return listener.state() != QPlcSlaveNode::RealTime; }, 30s));
    QCOMPARE(stepAside(master), StepResult::Complete);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    master.stop();
}

void tst_ExternalClock::aSecondCallerIsRefused()
{
    External master;
    HangingNode node;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.begin());
    node.hangs = true;
    Host host(master);
    QTRY_VERIFY(node.isHanging);
    QCOMPARE(master.step(), StepResult::Busy);
    QVERIFY(host.isInside());
    node.hangs = false;
    QCOMPARE(host.result(), StepResult::Complete);
    QCOMPARE(master.statistics().cycles, quint64(1));
    master.stop();
}

void tst_ExternalClock::stopEndsTheStep()
{
    External master(86'400s);
    HangingNode node;
    QVERIFY(master.listen() && master.admit(node, "udp"));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    node.hangs = true;
    Host host(master);
    QTRY_VERIFY(node.isHanging);
    QVERIFY(host.isInside());
    master.stop();
    QCOMPARE(host.resultWithoutEvents(), StepResult::Stopped);  // the node would let its thread wait
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    node.hangs = false;
}

void tst_ExternalClock::stopBetweenStepsEndsThePhase()
{
    External master;
    EchoNode node;
    QVERIFY(master.listen() && master.admit(node, "tcp"));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    ScriptedTool anna("Anna");
    QVERIFY(anna.greetAt(master.serverPort()));
    QCOMPARE(anna.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Registered);
    QCOMPARE(stepAside(master), StepResult::Stopped);
}

void tst_ExternalClock::phasesFollowEachOther()
{
    External master;
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.listen() && master.admit(counter, "udp") && master.admit(echo, "local"));
    QVector<quint64> digests;
    for (int phase = 0; phase < 3; ++phase) {
        QVERIFY(master.begin());
        for (int cycle = 0; cycle < 20; ++cycle)
            QCOMPARE(stepAside(master), StepResult::Complete);
        digests << master.statistics().imageDigest;
        master.stop();
        QTRY_COMPARE(counter.state(), QPlcSlaveNode::Registered);
    }
    QCOMPARE(digests, QVector<quint64>(3, digests.at(0)));
}

void tst_ExternalClock::aNodeThatHangsCostsTheLimitOnce()
{
    External master(100ms);
    HangingNode node;
    CounterNode counter;
    QVERIFY(master.listen() && master.admit(node, "udp") && master.admit(counter, "local"));
    QVERIFY(master.setLongestWait(20s) && master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    master.stop();
    QVERIFY(master.setLongestWait(100ms) && master.begin());
    node.hangs = true;
    const std::int64_t begin = qplc::monotonicNow();
    QCOMPARE(stepAside(master), StepResult::Late);
    QVERIFY(qplc::monotonicNow() - begin >= std::chrono::nanoseconds(100ms).count());
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(master.setLongestWait(24h));  // of the next phase
    constexpr int more = 300;             // of which each would cost the limit: half a minute
    const std::int64_t rest = qplc::monotonicNow();
    for (int cycle = 0; cycle < more; ++cycle)
        QCOMPARE(master.step(), StepResult::Late);
    QVERIFY(qplc::monotonicNow() - rest < more * std::chrono::nanoseconds(100ms).count());
    QCOMPARE(master.statistics().lateAnswers, quint64(more + 1));
    QCOMPARE(counter.count(), more + 1);
    node.hangs = false;
    QTRY_COMPARE(stepAside(master), StepResult::Complete);
    for (int cycle = 0; cycle < 5; ++cycle)
        QCOMPARE(stepAside(master), StepResult::Complete);  // it is waited for again
    master.stop();
}

void tst_ExternalClock::aNodeThatHangsMayStopThePlant_data()
{
    QTest::addColumn<int>("policy");
    QTest::addColumn<bool>("critical");
    QTest::newRow("SilentWait") << int(QPlcSlaveNode::SilentWait) << false;
    QTest::newRow("ErrorWait") << int(QPlcSlaveNode::ErrorWait) << false;
    QTest::newRow("SafeStopWhenLate") << int(QPlcSlaveNode::SafeStopWhenLate) << false;
    QTest::newRow("critical") << int(QPlcSlaveNode::SilentZeroOrderHold) << true;
}

void tst_ExternalClock::aNodeThatHangsMayStopThePlant()
{
    QFETCH(int, policy);
    QFETCH(bool, critical);
    External master(100ms);
    HangingNode node(static_cast<QPlcSlaveNode::RealTimeViolationPolicy>(policy));
    node.setCritical(critical);
    QVERIFY(master.listen() && master.admit(node, "udp"));
    QVERIFY(master.begin());
    node.hangs = true;
    QCOMPARE(stepAside(master), StepResult::SafeStop);
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("Hanging"), qPrintable(master.stateReason()));
    QCOMPARE(stepAside(master), StepResult::SafeStop);
    node.hangs = false;
    QTRY_COMPARE(node.state(), QPlcSlaveNode::SafeStop);  // it is told until it hears
    QTRY_VERIFY(master.reset());
    QCOMPARE(stepAside(master), StepResult::Stopped);
}

void tst_ExternalClock::aLostNodeMakesTheStepLate()
{
    External master(86'400s);
    auto node = std::make_unique<ScriptedNode>();
    node->outputs = QStringList{"sum"};
    QVERIFY(master.listen() && node->registerAt(master.serverPort()));
    QVERIFY(master.begin());
    Host host(master);
    QTRY_VERIFY(!node->requests.isEmpty());
    QVERIFY(host.isInside());
    node.reset();  // as if killed
    QCOMPARE(host.result(), StepResult::Late);
    QTRY_COMPARE(master.nodes().size(), 0);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QCOMPARE(stepAside(master), StepResult::Complete);  // it is not asked any more
    master.stop();
}

void tst_ExternalClock::aNodeLostBetweenStepsMakesTheNextOneLate_data()
{
    QTest::addColumn<int>("steps");
    QTest::newRow("before its first cycle") << 0;
    QTest::newRow("after an answer") << 3;
}

void tst_ExternalClock::aNodeLostBetweenStepsMakesTheNextOneLate()
{
    QFETCH(int, steps);
    External master(100ms);
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.listen() && master.admit(counter, "local") && master.admit(echo, "udp") && master.begin());
    for (int step = 0; step < steps; ++step)
        QCOMPARE(stepAside(master), StepResult::Complete);
    echo.disconnectFromMaster();
    QTRY_COMPARE(master.nodes().size(), 1);
    QCOMPARE(stepAside(master), StepResult::Late);
    QCOMPARE(stepAside(master), StepResult::Complete);  // it is told once
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    master.stop();
}

void tst_ExternalClock::aLostCriticalNodeStopsThePlantSafely()
{
    External master(86'400s);
    auto node = std::make_unique<ScriptedNode>();
    node->critical = true;
    EchoNode echo;
    node->outputs = QStringList{"sum"};
    QVERIFY(master.listen() && node->registerAt(master.serverPort()) && master.admit(echo, "udp"));
    QVERIFY(master.begin());
    Host host(master);
    QTRY_VERIFY(!node->requests.isEmpty());
    node.reset();
    const StepResult result = host.result();
    QVERIFY(result == StepResult::SafeStop || result == StepResult::Late);  // which thread is faster
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QCOMPARE(stepAside(master), StepResult::SafeStop);
    QTRY_COMPARE(echo.state(), QPlcSlaveNode::SafeStop);
}

void tst_ExternalClock::safeStopReachesNodesWithoutSteps()
{
    External master;
    EchoNode remote;
    CounterNode local;
    QVERIFY(master.listen() && master.admit(remote, "udp") && master.admit(local, "local"));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    QTRY_COMPARE(remote.state(), QPlcSlaveNode::RealTime);
    master.safeStop("test");
    QCOMPARE(master.state(), QPlcMasterNode::SafeStop);
    QTRY_COMPARE(remote.state(), QPlcSlaveNode::SafeStop);
    QCOMPARE(local.state(), QPlcSlaveNode::SafeStop);
    QTRY_VERIFY(master.statistics().cycles >= 3);  // they are told again and again
    QCOMPARE(stepAside(master), StepResult::SafeStop);
    QCOMPARE(local.count(), 1);
    QVERIFY(master.reset());
    QCOMPARE(stepAside(master), StepResult::Stopped);
    QTRY_COMPARE(remote.state(), QPlcSlaveNode::Registered);
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    master.stop();
}

void tst_ExternalClock::aLeaseEndsBetweenSteps()
{
    External master;
    EchoNode echo;
    QVERIFY(master.listen() && master.addLocalNode(&echo));
    ScriptedTool anna("Anna");
    QVERIFY(anna.greetAt(master.serverPort()));
    QVERIFY(master.begin() && anna.waitForMessage(QPlcMessage::StatesInitialized));
    anna.forgetMessages();
    const QJsonObject values{{"echo", "-1.5"}};
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"echo"}}, {"values", values}, {"timeout", 300e6}})
                 .kind(),
             QPlcMessage::Done);
    QCOMPARE(stepAside(master), StepResult::Complete);
    QCOMPARE(master.signalValue("echo").toReal(), -1.5);
    QTRY_VERIFY(!master.leases().isEmpty() && master.leases().at(0).isLost);  // no step meanwhile
    QCOMPARE(stepAside(master), StepResult::Complete);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    master.stop();
}

void tst_ExternalClock::aHostThatHangsStopsDevicesOnly()
{
    External master;
    CounterNode winch;
    EchoNode model;
    winch.setHardware(true);
    winch.activateWatchdog(100ms);
    model.activateWatchdog(100ms);
    QSignalSpy timedOut(&winch, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.listen() && master.admit(winch, "udp") && master.admit(model, "udp"));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    QTRY_COMPARE(timedOut.count(), 1);       // no step, for longer than the watchdog
    QTRY_COMPARE(master.nodes().size(), 2);  // it begins again
    QCOMPARE(model.state(), QPlcSlaveNode::RealTime);
    QCOMPARE(model.counters().watchdog, quint64(0));
    master.stop();
}

void tst_ExternalClock::devicesCannotBeLocal()
{
    External master;
    CounterNode winch("Winch");
    winch.setHardware(true);
    QVERIFY(master.addLocalNode(&winch));
    QVERIFY(!master.startRealTime());
    QCOMPARE(master.error(), QPlcMasterNode::NodeError);
    QVERIFY2(master.errorString().contains("'Winch'"), qPrintable(master.errorString()));
    QVERIFY(master.setClock(QPlcClock::lockstep()));
    QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
    master.stop();
}

QTEST_GUILESS_MAIN(tst_ExternalClock)
#include "tst_ExternalClock.moc"

// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "../realtime/FakeTime.h"
#include "SafeNode.h"
#include "ScriptedNode.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/MasterCycle.h"

using namespace std::chrono_literals;
using qplc::SafeStopFlag;

// What leads a master into its safe stop, and what does not.
class tst_SafeStopCauses : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void leavingCriticalNodeStopsThePlantUntilItReturns();
    void onlyAParticipatingNodeCountsAsReturned();
    void aNodeThatIsNotCriticalMayLeave();
    void aCriticalNodeThatFailsStopsThePlantSafely();
    void aCriticalNodeThatIsLateTooOftenStopsThePlant();
    void thePolicyStopsThePlantAtTheFirstLateAnswer();
    void aWaitThatIsTooLongStopsThePlant();
    void aCriticalNodeThatIsSafeByItselfStopsThePlantUntilItReturns();
    void aLateNodeThatDiesWhileTheMasterWaitsNeverHangsIt_data();
    void aLateNodeThatDiesWhileTheMasterWaitsNeverHangsIt();
    void aMasterThatStoodStillStopsSafely();
    void portInUseIsAFaultUntilAnotherPortOpens();
};

void tst_SafeStopCauses::leavingCriticalNodeStopsThePlantUntilItReturns()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    SafeNode winch;
    winch.setCritical(true);
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));
    QVERIFY(master.admit(winch, "udp"));
    QVERIFY(master.nodes().at(1).critical);
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(winch.steps > 3);
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("critical node 'Winch'"), qPrintable(master.stateReason()));
    QCOMPARE(master.error(), QPlcMasterNode::NodeError);
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.0);  // what it had written last does not stay

    QVERIFY(!master.reset());
    QVERIFY2(master.errorString().contains("'Winch' is not back"), qPrintable(master.errorString()));
    QCOMPARE(master.causeThatRemains(), QString("node 'Winch' is not back; start it again"));
    QVERIFY(master.admit(winch, "udp"));
    const int steps = winch.steps;
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    QCOMPARE(winch.steps.load(), steps);  // it is there, and waits
    QCOMPARE(master.nodes().at(1).state, QString("Registered"));
    QVERIFY(master.reset());
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(winch.steps > steps);
    master.stop();
    winch.disconnectFromMaster();
}

/// Somebody with its name is not enough: a listener does none of its work, and neither does who has
/// no cyclic channel yet.
void tst_SafeStopCauses::onlyAParticipatingNodeCountsAsReturned()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    winch.setCritical(true);
    QVERIFY(master.admit(winch, "udp") && master.startRealTime());
    QTRY_VERIFY(winch.steps > 3);
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));

    ScriptedNode listener("Winch");
    listener.listener = true;
    listener.outputs.clear();
    QVERIFY(listener.registerAt(master.serverPort()));
    QCOMPARE(master.causeThatRemains(), QString("node 'Winch' is not back; start it again"));
    listener.control.close();
    QTRY_VERIFY(master.nodes().isEmpty());

    ScriptedNode late("Winch");
    late.cyclic = "tcp";
    QVERIFY(late.connectTo(master.serverPort()));
    late.send(QPlcMessage::Hello, late.helloFields());
    QCOMPARE(late.next().kind(), QPlcMessage::Hello);
    late.send(QPlcMessage::Register, late.registerFields());
    QVERIFY(late.takeRegistered(late.next()));
    QCOMPARE(master.causeThatRemains(), QString("node 'Winch' is not back; start it again"));
    QVERIFY(!master.reset());
    QVERIFY(late.attach());
    QCOMPARE(master.causeThatRemains(), QString());
    QVERIFY(master.reset());
}

void tst_SafeStopCauses::aNodeThatIsNotCriticalMayLeave()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, "udp"));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(winch.steps > 3);
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    winch.disconnectFromMaster();
    QCOMPARE(winch.safeStates.load(), 1);  // it leaves in its safe state
    QTRY_COMPARE(lost.size(), 1);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
}

void tst_SafeStopCauses::aCriticalNodeThatFailsStopsThePlantSafely()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    SafeNode winch;
    winch.setCritical(true);
    winch.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 5)
            throw std::runtime_error("no encoder");
    };
    QVERIFY(master.admit(winch, "udp"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("'Winch'"), qPrintable(master.stateReason()));
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Fault);
    QTRY_COMPARE(master.nodes().at(0).state, QString("Fault"));
    QCOMPARE(winch.safeStates.load(), 1);
    QCOMPARE(winch.reason.load(), int(QPlcSlaveNode::CodeFailed));
    QVERIFY(master.reset());
    winch.onStep = {};
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::RealTime);
    master.stop();
    winch.disconnectFromMaster();
}

void tst_SafeStopCauses::aCriticalNodeThatIsLateTooOftenStopsThePlant()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    SafeNode winch;
    winch.setCritical(true);
    QSemaphore goOn;
    winch.onStep = [&](const QPlcCycle &cycle) {
        if (cycle.number() >= 3)
            goOn.acquire();
    };
    QVERIFY(master.admit(winch, "udp"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("late too often"), qPrintable(master.stateReason()));
    QVERIFY(master.nodes().at(0).lateAnswers >= 5);
    QVERIFY(!master.reset());
    QVERIFY2(master.errorString().contains("still answers late"), qPrintable(master.errorString()));
    goOn.release(1000);
    QTRY_VERIFY(master.causeThatRemains().isEmpty());
    QVERIFY(master.reset());
    winch.disconnectFromMaster();
}

void tst_SafeStopCauses::thePolicyStopsThePlantAtTheFirstLateAnswer()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SafeStopWhenLate";
    QVERIFY(node.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("'Scripted' was late in cycle 0"), qPrintable(master.stateReason()));
    QTRY_COMPARE(violated.size(), 1);
    QVERIFY(node.waitForRequests(3));
    QCOMPARE(int(node.requests.at(0).flags), 0);
    QCOMPARE(int(node.requests.at(1).flags), int(SafeStopFlag));  // the very next cycle
}

void tst_SafeStopCauses::aWaitThatIsTooLongStopsThePlant()
{
    TestMaster master(QPlcClock::realTime());
    master.setLongestWait(200ms);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentWait";
    QVERIFY(node.registerAt(master.serverPort()));
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("'Scripted' did not answer cycle 0"), qPrintable(master.stateReason()));
    QCOMPARE(states.at(states.size() - 2).at(0).value<QPlcMasterNode::State>(), QPlcMasterNode::WaitingForLateSlaves);
    QVERIFY(master.waitForCycles(3));  // and nobody is waited for any more
}

/// Its watchdog has expired, and frames arrive again: it answers in time, and moves nothing.
void tst_SafeStopCauses::aCriticalNodeThatIsSafeByItselfStopsThePlantUntilItReturns()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode winch("Winch");
    winch.onRequest = [&](const ScriptedNode::Request &request) {
        winch.answer(request.cycle, winch.initialValues, request.cycle > 5 ? qplc::SafeStopFlag : 0);
    };
    winch.critical = true;
    QVERIFY(winch.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("critical node 'Winch' is in its safe state since cycle "),
             qPrintable(master.stateReason()));
    winch.control.abort();
    QTRY_COMPARE(master.causeThatRemains(), QString("node 'Winch' is not back; start it again"));
    QVERIFY(!master.reset());
    master.stop();
}

void tst_SafeStopCauses::aLateNodeThatDiesWhileTheMasterWaitsNeverHangsIt_data()
{
    QTest::addColumn<bool>("critical");
    QTest::newRow("critical") << true;
    QTest::newRow("any other") << false;
}

void tst_SafeStopCauses::aLateNodeThatDiesWhileTheMasterWaitsNeverHangsIt()
{
    QFETCH(bool, critical);
    TestMaster master(QPlcClock::realTime());
    master.setLongestWait(0ns);  // for ever
    QVERIFY(master.listen());
    ScriptedNode late("Late");
    late.policy = "SilentWait";
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));
    late.critical = critical;
    QVERIFY(late.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::WaitingForLateSlaves));
    late.control.abort();
    QVERIFY(master.waitForState(critical ? QPlcMasterNode::SafeStop : QPlcMasterNode::RealTime));
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    master.stop();
}

void tst_SafeStopCauses::aMasterThatStoodStillStopsSafely()
{
    class Sleeper : public QPlcCompactSlaveNode
    {
    public:
        explicit Sleeper(FakeTime &fakeTime)
            : QPlcCompactSlaveNode("Sleeper")
            , m_time(fakeTime)
        {
        }
        QVector<quint64> steps;
        int safeStates = 0;

    protected:
        void step(const QPlcCycle &cycle) override
        {
            steps << cycle.number();
            m_echo = 5.0;
            m_time.time += cycle.number() == 3 ? 990'000'000 : cycle.number() == 200 ? 1'020'000'000 : 1'000'000;
        }
        void safeState(SafeStateReason) override { ++safeStates; }

    private:
        FakeTime &m_time;
        QPlcOutput<double> m_echo{this, "echo"};
    };
    FakeTime time;
    Sleeper node(time);
    qplc::NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(testTable(), &error) && runtime.reset(&error));
    qplc::CyclicHub hub;
    qplc::MasterCycle cycle(testTable(), hub, false, &time);
    const auto slot = std::make_shared<qplc::NodeSlot>();
    slot->local = &runtime;
    slot->outputLayout = runtime.outputLayout();
    slot->prepare(cycle.image(), 5);
    qplc::Roster roster;
    roster.nodes = {slot};
    roster.safe.assign(std::size_t(testTable().indexOf("echo")) + 1, false);
    roster.safe.back() = true;
    cycle.setRoster(roster);
    qplc::MasterCycle::Phase phase;
    phase.period = 10ms;
    phase.cycleLimit = 1000;
    phase.gapLimit = 1s;
    QVERIFY(cycle.start(phase));
    QVector<qplc::CycleEvent> events;
    QVERIFY(waitUntil([&] {
        cycle.reports().take([&](const qplc::CycleEvent &event) { events << event; }, [](const qplc::TappedFrame &) {});
        return !events.isEmpty();
    }));
    const std::uint64_t newest = cycle.cycle();
    QVERIFY(waitUntil([&] { return cycle.cycle() > newest + 10; }));  // beyond the limit, too
    cycle.stop();
    QCOMPARE(events.at(0).kind, qplc::CycleEvent::TrippedByGap);
    QCOMPARE(events.at(0).cycle, quint64(302));  // 0.99 s were borne; 1.02 s skip 101 cycles
    QCOMPARE(events.at(0).duration, qint64(1'010'000'000));
    QCOMPARE(node.steps.last(), quint64(200));
    QCOMPARE(node.safeStates, 1);
    QCOMPARE(cycle.value(testTable().indexOf("echo")).toReal(), 0.0);
    cycle.setRoster({});
}

void tst_SafeStopCauses::portInUseIsAFaultUntilAnotherPortOpens()
{
    TestMaster first;
    QVERIFY(first.listen());
    TestMaster master;
    QVERIFY(!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, first.serverPort())));
    QCOMPARE(master.state(), QPlcMasterNode::Fault);
    QVERIFY2(master.stateReason().contains("cannot listen"), qPrintable(master.stateReason()));
    QVERIFY(!master.startRealTime());
    QVERIFY(master.errorString().contains("fault latched: cannot listen"));
    QVERIFY(master.listen());
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY(!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, first.serverPort())));
    QVERIFY(master.reset());
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

QTEST_GUILESS_MAIN(tst_SafeStopCauses)
#include "tst_SafeStopCauses.moc"

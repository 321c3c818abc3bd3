// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

#include <numeric>

using State = QPlcMasterNode::State;

// What becomes of the cycle when the answer of a node is late.
class tst_RealTimeViolationPolicies : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void zeroOrderHoldContinuesWithHeldValues_data();
    void zeroOrderHoldContinuesWithHeldValues();
    void waitStopsTimeUntilTheAnswerArrives_data();
    void waitStopsTimeUntilTheAnswerArrives();
    void onlyTheAnswerOfThisCycleEndsTheWait();
    void lateAnswerReplacesTheHeldValue();
    void answerOfThePreviousCycleCountsAsLate();
    void waitEndsWhenTheLateNodeDies_data();
    void waitEndsWhenTheLateNodeDies();
    void stopEndsTheWait();
    void stopCausesNoViolation();
    void masterNeverWaitsForAListener();
    void overrunsSkipToTheGrid();
};

void tst_RealTimeViolationPolicies::zeroOrderHoldContinuesWithHeldValues_data()
{
    QTest::addColumn<QString>("policy");
    QTest::addColumn<bool>("reports");
    QTest::newRow("silent") << "SilentZeroOrderHold" << false;
    QTest::newRow("error") << "ErrorZeroOrderHold" << true;
}

void tst_RealTimeViolationPolicies::zeroOrderHoldContinuesWithHeldValues()
{
    QFETCH(QString, policy);
    QFETCH(bool, reports);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = policy;
    node.initialValues = QPlcValue(4.5).toBytes();
    QVERIFY(node.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(10));
    master.stop();
    QCOMPARE(states.size(), 3);  // Initializing, RealTime, Off: it never waited
    QCOMPARE(master.signalValue("echo").toReal(), 4.5);
    const quint64 late = master.nodes().at(0).lateAnswers;
    QVERIFY(late >= 9);
    QCOMPARE(master.statistics().lateAnswers, late);
    QCOMPARE(master.nodes().at(0).resent, quint64(0));
    QCOMPARE(violated.size(), reports ? int(late) : 0);
    if (reports) {
        QCOMPARE(violated.at(0).at(0).toString(), QString("Scripted"));
        QCOMPARE(violated.at(0).at(1).toULongLong(), quint64(0));
    }
}

void tst_RealTimeViolationPolicies::waitStopsTimeUntilTheAnswerArrives_data()
{
    QTest::addColumn<QString>("policy");
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("reports");
    QTest::newRow("silent, udp") << "SilentWait"
                                 << "udp" << false;
    QTest::newRow("error, tcp") << "ErrorWait"
                                << "tcp" << true;
}

void tst_RealTimeViolationPolicies::waitStopsTimeUntilTheAnswerArrives()
{
    QFETCH(QString, policy);
    QFETCH(QString, kind);
    QFETCH(bool, reports);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.020);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = policy;
    node.cyclic = kind;
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));
    QVERIFY(node.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(State::WaitingForLateSlaves));
    QCOMPARE(master.statistics().cycles, quint64(0));  // nothing is complete
    QTest::qWait(200);                                 // ten periods during which nothing may happen
    QCOMPARE(master.statistics().cycles, quint64(0));
    QCOMPARE(master.nodes().at(1).resent > 0, kind == "udp");
    QCOMPARE(master.nodes().at(1).lateAnswers, quint64(1));
    node.answerAll();
    node.answer(node.requests.at(0).cycle, 1.0);
    QVERIFY(master.waitForState(State::RealTime));
    QVERIFY(master.waitForCycles(3));
    master.stop();
    QVERIFY2(master.statistics().skippedCycles < 10, "the time of the wait was not taken out of the grid");
    QCOMPARE(violated.size() > 0, reports);
    QVERIFY(other.lastCycle + 1 >= master.statistics().cycles);
}

void tst_RealTimeViolationPolicies::onlyTheAnswerOfThisCycleEndsTheWait()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentWait";
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(State::WaitingForLateSlaves));
    const quint64 first = node.requests.at(0).cycle;
    node.answer(first, 1.0);
    QVERIFY(node.waitForRequests(2));
    QVERIFY(master.waitForState(State::WaitingForLateSlaves));
    node.answer(first, 2.0);  // again that of the cycle before
    QTRY_COMPARE(master.nodes().at(0).duplicates, quint64(1));
    QCOMPARE(master.statistics().cycles, quint64(1));
    QCOMPARE(master.state(), State::WaitingForLateSlaves);
    node.answer(first + 1, 3.0);
    QVERIFY(master.waitForCycles(2));
    QCOMPARE(master.signalValue("echo").toReal(), 3.0);
    master.stop();
}

void tst_RealTimeViolationPolicies::lateAnswerReplacesTheHeldValue()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentZeroOrderHold";
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForRequests(5));
    node.answer(node.requests.at(0).cycle, 7.0);  // four cycles late
    QTRY_COMPARE(master.signalValue("echo").toReal(), 7.0);
    const quint64 late = master.nodes().at(0).lateAnswers;
    QVERIFY(late >= 4);
    master.stop();
}

void tst_RealTimeViolationPolicies::answerOfThePreviousCycleCountsAsLate()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.010);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentZeroOrderHold";
    QVERIFY(node.registerAt(master.serverPort()));
    node.onRequest = [&](const ScriptedNode::Request &request) {
        if (node.requests.size() > 1)
            node.answer(request.cycle - 1, 1.0);  // always one cycle behind
    };
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(10));
    master.stop();
    QVERIFY(node.requests.size() > 5);
    QVERIFY(master.nodes().at(0).lateAnswers + 1
            >= master.statistics().cycles);  // every cycle but, at most, the one that stop() has cut short
}

void tst_RealTimeViolationPolicies::waitEndsWhenTheLateNodeDies_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("lockstep");
    QTest::addColumn<bool>("controlDies");
    QTest::newRow("udp, real time, control connection") << "udp" << false << true;
    QTest::newRow("udp, lockstep, control connection") << "udp" << true << true;
    QTest::newRow("tcp, real time, control connection") << "tcp" << false << true;
    QTest::newRow("tcp, real time, cyclic connection") << "tcp" << false << false;
    QTest::newRow("tcp, lockstep, cyclic connection") << "tcp" << true << false;
}

void tst_RealTimeViolationPolicies::waitEndsWhenTheLateNodeDies()
{
    QFETCH(QString, kind);
    QFETCH(bool, lockstep);
    QFETCH(bool, controlDies);
    TestMaster master(lockstep ? QPlcClock::lockstep() : QPlcClock::realTime());
    master.setInterval(0.005);
    ScriptedNode node("Mortal");
    node.policy = "ErrorWait";
    node.cyclic = kind;
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    QVERIFY(node.beginWith(master));
    if (!lockstep)
        QVERIFY(master.waitForState(State::WaitingForLateSlaves));
    if (controlDies)
        node.control.abort();
    else
        node.stream.abort();
    QTRY_COMPARE(lost.size(), 1);
    QCOMPARE(lost.at(0).at(0).toString(), QString("Mortal"));
    QVERIFY(master.waitForCycles(5));  // the others go on
    QVERIFY(master.waitForState(State::RealTime));
    QCOMPARE(master.writer("echo"), QString());
    master.stop();
}

void tst_RealTimeViolationPolicies::stopEndsTheWait()
{
    for (QPlcClock clock : {QPlcClock::realTime(), QPlcClock::lockstep()}) {
        TestMaster master(clock);
        QVERIFY(master.listen());
        ScriptedNode node;
        node.policy = "SilentWait";
        QVERIFY(node.registerAt(master.serverPort()));
        QVERIFY(master.startRealTime());
        QVERIFY(node.waitForRequests(1));
        QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
        master.stop();
        QCOMPARE(stopped.size(), 1);
        QCOMPARE(master.state(), State::Off);
    }
}

void tst_RealTimeViolationPolicies::stopCausesNoViolation()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(5.0);
    ScriptedNode node;
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(node.beginWith(master));
    master.stop();  // long before the answer was due
    QCOMPARE(violated.size(), 0);
    QCOMPARE(master.statistics().lateAnswers, quint64(0));
}

void tst_RealTimeViolationPolicies::masterNeverWaitsForAListener()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.005);
    QVERIFY(master.listen());
    ScriptedNode node;
    node.policy = "SilentWait";
    node.listener = true;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForRequests(5));  // it is asked like all others, and never answers
    QCOMPARE(master.state(), State::RealTime);
    master.stop();
    QCOMPARE(master.statistics().lateAnswers, quint64(0));  // nor is the rest of the period spent on it
}

void tst_RealTimeViolationPolicies::overrunsSkipToTheGrid()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.001);
    CounterNode slow;
    QVector<quint64> missed;
    slow.onStep = [&](const QPlcCycle &cycle) {
        missed << cycle.missedCycles();
        if (cycle.number() > 0)
            return;
        QElapsedTimer timer;  // the first cycle takes five periods
        timer.start();
        while (timer.elapsed() < 5) {}
    };
    QVERIFY(master.addLocalNode(&slow));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    master.stop();
    const QPlcMasterStatistics statistics = master.statistics();
    QVERIFY(statistics.overruns >= 1);
    QVERIFY(statistics.skippedCycles >= 4);
    QCOMPARE(statistics.cycles + statistics.skippedCycles, slow.lastCycle + 1);  // the number of a cycle tells its time
    QVERIFY(missed.size() > 1 && missed.at(1) >= 4);
    QCOMPARE(std::accumulate(missed.begin(), missed.end(), quint64(0)), statistics.skippedCycles);
    QVERIFY(statistics.latenessMaximum < 1'000'000);  // beyond a period a cycle is skipped
}

QTEST_GUILESS_MAIN(tst_RealTimeViolationPolicies)
#include "tst_RealTimeViolationPolicies.moc"

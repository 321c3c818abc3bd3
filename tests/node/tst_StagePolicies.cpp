// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SameCycleFixtures.h"
#include "VirtualTime.h"

#include <algorithm>
#include <optional>

// What becomes of a cycle of several stages when an answer is late.
class tst_StagePolicies : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void lateTwoPhaseAnswerIsUsedImmediately();
    void lateStageEndsAfterItsShareOfThePeriod();
    void nodeWithoutSameCycleReadersDelaysNoStage();
    void waitingInAStageStopsTime();
    void stopEndsTheWaitWithinAStage();
};

void tst_StagePolicies::lateTwoPhaseAnswerIsUsedImmediately()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.200);
    master.setCycleLimit(2);
    QVERIFY(master.listen());
    ScriptedNode model;
    model.policy = "SilentZeroOrderHold";
    QVERIFY(registerOrdered(model, master.serverPort(), true, false));
    QVERIFY(master.startRealTime());
    QVERIFY(model.waitForRequests(2));
    model.answer(model.requests.at(0).cycle, 7.0);      // y(1), in cycle 1
    QVERIFY(master.waitForState(QPlcMasterNode::Off));  // the last cycle: none is left to count in
    QCOMPARE(master.signalValue("echo").toReal(), 7.0);
}

void tst_StagePolicies::lateStageEndsAfterItsShareOfThePeriod()
{
    TestMaster master(QPlcClock::realTime());
    constexpr qint64 period = 100'000'000;  // [ns]
    master.setInterval(std::chrono::nanoseconds(period));
    QVERIFY(master.listen());
    ScriptedNode silent;  // "count" -> "echo", and never an answer
    silent.initialValues = QPlcValue(4.5).toBytes();
    QVERIFY(silent.registerAt(master.serverPort()));
    QVector<qint64> firstSteps;
    QVector<qint64> secondSteps;
    QVector<double> seen;
    CounterNode counter;  // in the first stage: "echo" of the last cycle
    counter.onStep = [&](const QPlcCycle &) { firstSteps << qplc::monotonicNow(); };
    Adder adder("Adder", "echo", "setpoint", QPlcInputTiming::SameCycle);
    adder.onStep = [&](const QPlcCycle &, double echo) {
        secondSteps << qplc::monotonicNow();
        seen << echo;
    };
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.addLocalNode(&adder));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(5));
    master.stop();
    QCOMPARE(seen, QVector<double>(5, 4.5));
    for (int i = 0; i < 5; ++i)
        QCOMPARE(secondSteps.at(i) - firstSteps.at(i), period / 2);
    QCOMPARE(master.nodes().at(0).lateAnswers, quint64(5));  // once a cycle
    QCOMPARE(violated.size(), 5);
}

void tst_StagePolicies::nodeWithoutSameCycleReadersDelaysNoStage()
{
    TestMaster master;  // lockstep: a stage that waited for it would wait for ever
    QVERIFY(master.listen());
    ScriptedNode silent;
    silent.inputs.clear();
    silent.outputs = QStringList{"sum"};  // read in the next cycle only
    QVERIFY(silent.registerAt(master.serverPort()));
    Adder first("First", "sum", "setpoint", QPlcInputTiming::LastCycle);
    Adder second("Second", "setpoint", "echo", QPlcInputTiming::SameCycle);
    std::atomic<int> steps{0};
    second.onStep = [&](const QPlcCycle &, double) { ++steps; };
    QVERIFY(master.addLocalNode(&first));
    QVERIFY(master.addLocalNode(&second));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(steps.load(), 1);
    QVERIFY(silent.waitForRequests(1));
    QCOMPARE(master.statistics().cycles, quint64(0));  // the end of the cycle waits for all
    silent.answerAll();
    silent.answer(silent.requests.at(0).cycle, 3.0);
    QVERIFY(master.waitForCycles(10));
    master.stop();
}

void tst_StagePolicies::waitingInAStageStopsTime()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.020);
    QVERIFY(master.listen());
    ScriptedNode slow;
    slow.policy = "SilentWait";
    QVERIFY(slow.registerAt(master.serverPort()));
    Adder adder("Adder", "echo", "setpoint", QPlcInputTiming::SameCycle);
    QVector<double> seen;
    adder.onStep = [&](const QPlcCycle &, double echo) { seen << echo; };
    QVERIFY(master.addLocalNode(&adder));
    QVERIFY(master.startRealTime());
    QVERIFY(slow.waitForRequests(1));
    QVERIFY(slow.waitForRequestOf(slow.requests.at(0).cycle, 1));  // the request is repeated
    QTRY_COMPARE(master.state(), QPlcMasterNode::WaitingForLateSlaves);
    slow.answer(slow.requests.at(0).cycle, 9.0);
    QVERIFY(slow.waitForRequests(2));
    QCOMPARE(slow.requests.at(1).cycle, slow.requests.at(0).cycle + 1);  // nothing was skipped
    slow.answer(slow.requests.at(1).cycle, 10.0);
    QTRY_VERIFY(master.statistics().cycles >= 2);
    QCOMPARE(master.statistics().skippedCycles, quint64(0));
    master.stop();
    QVERIFY(seen.size() >= 2);
    QCOMPARE(seen.at(0), 9.0);
    QCOMPARE(seen.at(1), 10.0);
}

void tst_StagePolicies::stopEndsTheWaitWithinAStage()
{
    for (const QPlcClock clock : {QPlcClock::lockstep(), QPlcClock::realTime()}) {
        TestMaster master(clock);
        master.setInterval(1.0);
        QVERIFY(master.listen());
        ScriptedNode silent;
        silent.policy = "ErrorWait";
        QVERIFY(silent.registerAt(master.serverPort()));
        Adder adder("Adder", "echo", "setpoint", QPlcInputTiming::SameCycle);
        bool stepped = false;
        adder.onStep = [&](const QPlcCycle &, double) { stepped = true; };
        QVERIFY(master.addLocalNode(&adder));
        QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
        QVERIFY(master.startRealTime());
        QVERIFY(silent.waitForRequests(1));
        master.stop();
        QVERIFY(!stepped);  // nobody computes with half a cycle
        QCOMPARE(violated.size(), 0);
    }
}

QTPLC_VIRTUAL_TIME_MAIN(tst_StagePolicies)
#include "tst_StagePolicies.moc"

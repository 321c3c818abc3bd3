// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "Stepping.h"
#include "VirtualTime.h"

// A host that turns the clock, in virtual time: how long a step takes is exact there.
class tst_SimulatedSteps : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }

    void resultsAreThoseOfLockstep();
    void theLimitIsExact();
    void theLimitIsThatOfAllStages();
    void stopEndsTheStepWithoutDelay();
    void aNodeIsWaitedForAgainWhenItHasAnswered();
    void aPlantIsResetWhenItsNodeAnswersAgain();
};

namespace {

/// How long a step takes [ns].
std::int64_t durationOf(QPlcMasterNode &master, StepResult expected)
{
    std::int64_t duration = -1;
    qplc::CycleThread host;
    const auto body = [&] {
        const std::int64_t begin = qplc::monotonicNow();
        const StepResult result = master.step();
        duration = result == expected ? qplc::monotonicNow() - begin : -2;
    };
    if (!host.start("host", {}, body) || !waitUntil([&] { return duration != -1; }, 30s))
        return -1;
    return duration;
}

/// Computes after the node that writes the setpoint, and does not end.
class SecondStage : public QPlcCompactSlaveNode
{
public:
    SecondStage()
        : QPlcCompactSlaveNode("Second")
    {
    }
    ~SecondStage() override { m_hangs = false; }
    void goOn() { m_hangs = false; }

private:
    QPlcInput<double> m_setpoint{this, "setpoint", QPlcInputTiming::SameCycle};
    QPlcOutput<double> m_echo{this, "echo"};
    std::atomic<bool> m_hangs{true};

    void step(const QPlcCycle &) override
    {
        m_echo = m_setpoint + 1.0;
        while (m_hangs)
            beBusyFor(1ms);
    }
};

constexpr std::int64_t asNanoseconds(std::chrono::nanoseconds duration)
{
    return duration.count();
}

}  // namespace

void tst_SimulatedSteps::resultsAreThoseOfLockstep()
{
    constexpr quint64 cycles = 200;
    QVector<quint64> digests;
    for (const QPlcClock clock : {QPlcClock::lockstep(), QPlcClock::external()}) {
        TestMaster master(clock);
        master.setCycleLimit(cycles);
        CounterNode counter;
        EchoNode echo;
        QVERIFY(master.listen() && master.admit(counter, "sim") && master.admit(echo, "sim"));
        QVERIFY(master.startRealTime());
        if (clock.isExternal()) {
            QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
            for (quint64 cycle = 0; cycle < cycles; ++cycle)
                QCOMPARE(stepAside(master), StepResult::Complete);
        }
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.statistics().cycles, cycles);
        digests << master.statistics().imageDigest;
    }
    QCOMPARE(digests.at(1), digests.at(0));
}

void tst_SimulatedSteps::theLimitIsExact()
{
    External master(250ms);
    HangingNode node;
    QVERIFY(master.listen() && master.admit(node, "sim"));
    QVERIFY(master.begin());
    QVERIFY(durationOf(master, StepResult::Complete) >= 0);
    node.hangs = true;
    QCOMPARE(durationOf(master, StepResult::Late), asNanoseconds(250ms));
    for (int cycle = 0; cycle < 5; ++cycle)
        QCOMPARE(durationOf(master, StepResult::Late), std::int64_t(0));  // it has cost the limit once
    node.hangs = false;
    master.stop();
}

void tst_SimulatedSteps::theLimitIsThatOfAllStages()
{
    External master(250ms);
    ScriptedNode writer("Writer");  // does not answer, either
    writer.inputs = QStringList{"free"};
    writer.outputs = QStringList{"setpoint"};
    SecondStage second;
    QVERIFY(master.listen() && writer.registerAt(master.serverPort()) && master.admit(second, "sim"));
    QVERIFY(master.begin());
    QCOMPARE(master.schedule().stages.size(), 2);
    QCOMPARE(durationOf(master, StepResult::Late), asNanoseconds(250ms));
    QCOMPARE(master.statistics().lateAnswers, quint64(2));
    second.goOn();
    master.stop();
}

void tst_SimulatedSteps::stopEndsTheStepWithoutDelay()
{
    External master(24h);
    ScriptedNode silent;
    silent.outputs = QStringList{"sum"};
    QVERIFY(master.listen() && silent.registerAt(master.serverPort()));
    QVERIFY(master.begin());
    Host host(master);
    QTRY_VERIFY(!silent.requests.isEmpty());
    QVERIFY(host.isInside());
    const std::int64_t begin = qplc::monotonicNow();
    master.stop();
    QVERIFY(!host.isInside());
    QCOMPARE(qplc::monotonicNow(), begin);
    QCOMPARE(host.result(), StepResult::Stopped);
}

void tst_SimulatedSteps::aNodeIsWaitedForAgainWhenItHasAnswered()
{
    External master(250ms);
    HangingNode node;
    QVERIFY(master.listen() && master.admit(node, "sim"));
    QVERIFY(master.begin());
    node.hangs = true;
    QCOMPARE(stepAside(master), StepResult::Late);
    QCOMPARE(stepAside(master), StepResult::Late);
    node.hangs = false;
    pass(50ms);
    QCOMPARE(stepAside(master), StepResult::Late);  // takes the answers to the cycles before
    for (int cycle = 0; cycle < 5; ++cycle)
        QCOMPARE(stepAside(master), StepResult::Complete);
    master.stop();
}

/// Its answers in a safe stop take a while, as on every network.
void tst_SimulatedSteps::aPlantIsResetWhenItsNodeAnswersAgain()
{
    External master(50ms);
    HangingNode node;
    node.setCritical(true);
    QVERIFY(master.listen() && master.admit(node, "sim"));
    QVERIFY(master.begin());
    node.hangs = true;
    QCOMPARE(stepAside(master), StepResult::SafeStop);
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    pass(1s);
    QVERIFY(!master.reset());
    QVERIFY2(master.errorString().contains("still answers late"), qPrintable(master.errorString()));
    node.hangs = false;
    pass(300ms);
    QVERIFY2(master.reset(), qPrintable(master.errorString()));
    QVERIFY(master.begin());
    QCOMPARE(stepAside(master), StepResult::Complete);
    master.stop();
}

QTPLC_VIRTUAL_TIME_MAIN(tst_SimulatedSteps)
#include "tst_SimulatedSteps.moc"

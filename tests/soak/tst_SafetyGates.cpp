// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include <QtTest/QtTest>

using soak::FaultKind;
using soak::Gate;
using soak::Record;

class tst_SafetyGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void plantWithoutQualitiesIsNotJudged();
    void stoppedWriterHasToBecomeSafeForItsReaders();
    void aDriveThatGoesSafeInTimePasses();
    void aDriveThatIsHeldForTooLongIsFound();
    void aNodeThatGoesSafeInTimePasses();
    void aNodeThatGoesSafeTooLateIsFound();
    void aNodeThatNeverGoesSafeIsFound();
    void aNodeThatTheMachineStalledIsExcused();
    void aNodeThatWaitedForAProcessorIsExcused();
    void aStoppedNodeCannotGoSafe();
    void aNodeThatMovesAfterASafeStateIsFound();
    void aSafeNodeThatComputesWithASafeDriveIsFound();
    void aNodeThatComputesInASafeStopIsFound();
    void aCycleThatBeganAfterAGapAndBeforeASafeStopIsComputed();
    void cyclesOfAFormerPhaseAllowNothingInASafeStop();
    void safeStateWithUnsafeValuesIsFound();
    void aNewPhaseEndsASafeState();
    void aMasterThatStartsByItselfIsFound();
    void aRestartedMasterNeedsANewCommand();
    void waitingMasterMayResumeByItself();
    void anAlarmWithoutAFaultIsFound();
    void safeStateAtPhaseEndCountsAsNoAlarm();
    void anAlarmOfAFaultIsExplained();
    void theLossOfAnotherNodeIsNotExplained();
    void anAlarmInAStallIsExcused();
    void lossIsJudgedAtTheNodeThatDetectedItFirst();
    void unreportedSafeStopIsFound();
    void anEvictedNodeThatStaysOutPasses();
    void anEvictedNodeThatRegistersIsFound();
    void anEvictedNodeThatMovesIsFound();
    void aStartWithoutAnEvictedNodeIsFound();
    void aNewMasterKeepsNobodyOut();
};

namespace {

constexpr qint64 ms = HandMade::Millisecond;

/// Node 1 gets nothing from cycle 50 on, and says at \a safeAt that it is safe (0: never); then the
/// master is back.
HandMade silence(qint64 safeAt)
{
    HandMade plant;
    plant.addFault(FaultKind::StopMaster, -1, HandMade::at(49) + 2 * ms, HandMade::at(80));
    HandMade::removeCycles(plant.node(1), 50, 79);
    HandMade::removeCycles(plant.node(0), 50, 99);
    HandMade::removeCycles(plant.node(2), 50, 99);
    plant.step(1, 80).numbers[Record::Missed] = 30;
    if (safeAt > 0)
        HandMade::add(plant.node(1), Record::Safe, 1, safeAt, {soak::bitsOf(soak::SafeDrive)});
    return plant;
}

/// All nodes tell the quality of their drive; from cycle 50 on node 0 is silent, and node 1 goes
/// safe after \a held cycles.
HandMade silentWriter(int held)
{
    HandMade plant;
    for (int node = 0; node < 3; ++node) {
        for (quint64 cycle = 0; cycle < 100; ++cycle) {
            Record &step = plant.step(node, cycle);
            step.numbers[Record::Quality] = 0;
            if (node != 1 || cycle < 50)
                continue;
            const bool isHeld = cycle < quint64(50 + held);
            step.numbers[Record::SeenCounter] = isHeld ? 50 : 0;
            step.numbers[Record::SeenLife] = isHeld ? 1 : 0;
            step.numbers[Record::Drive] = soak::bitsOf(isHeld ? 0.5 : soak::SafeDrive);
        }
    }
    return plant;
}

/// Node 1 is out from cycle 50 to cycle 80.
HandMade eviction()
{
    HandMade plant;
    plant.addFault(FaultKind::EvictNode, 1, HandMade::at(50), HandMade::at(80));
    HandMade::add(plant.runner(), Record::Evicted, 1, HandMade::at(50));
    HandMade::add(plant.runner(), Record::Admitted, 1, HandMade::at(80));
    HandMade::removeCycles(plant.node(1), 51, 99);
    return plant;
}

}  // namespace

void tst_SafetyGates::plantWithoutQualitiesIsNotJudged()
{
    HandMade plant;
    QVERIFY(!plant.judge(&soak::silentWritersBecomeSafe).isAsked);
}

void tst_SafetyGates::stoppedWriterHasToBecomeSafeForItsReaders()
{
    HandMade plant;
    for (quint64 cycle = 0; cycle < 100; ++cycle)
        plant.step(1, cycle).numbers[Record::Quality] = 0;
    QVERIFY(!plant.judge(&soak::silentWritersBecomeSafe).isAsked);
    plant.addFault(FaultKind::StopNode, 0, HandMade::at(50), HandMade::at(80), 300);
    const Gate gate = plant.judge(&soak::silentWritersBecomeSafe);
    QVERIFY2(gate.isAsked && !gate.passed(), textOf(gate));
}

void tst_SafetyGates::aDriveThatGoesSafeInTimePasses()
{
    HandMade plant = silentWriter(3);
    const Gate gate = plant.judge(&soak::silentWritersBecomeSafe);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(47));
}

void tst_SafetyGates::aDriveThatIsHeldForTooLongIsFound()
{
    HandMade plant = silentWriter(4);
    const Gate gate = plant.judge(&soak::silentWritersBecomeSafe);
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("cycle 53"), textOf(gate));
}

void tst_SafetyGates::aNodeThatGoesSafeInTimePasses()
{
    HandMade plant = silence(HandMade::at(49) + 43 * ms);  // its last step was 1 ms after the begin of cycle 49
    const Gate gate = plant.judge(&soak::nodesAloneBecomeSafe);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(1));
    QCOMPARE(gate.figures["longest until safe [ms]"], 42.0);
}

void tst_SafetyGates::aNodeThatGoesSafeTooLateIsFound()
{
    HandMade plant = silence(HandMade::at(49) + 44 * ms);
    QCOMPARE(plant.judge(&soak::nodesAloneBecomeSafe).failed, qint64(1));
}

void tst_SafetyGates::aNodeThatNeverGoesSafeIsFound()
{
    HandMade plant = silence(0);
    const Gate gate = plant.judge(&soak::nodesAloneBecomeSafe);
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("not safe at all"), textOf(gate));
}

void tst_SafetyGates::aNodeThatTheMachineStalledIsExcused()
{
    HandMade plant = silence(HandMade::at(49) + 44 * ms);
    HandMade::add(plant.runner(), Record::Stall, -1, HandMade::at(49) + 40 * ms, {quint64(HandMade::at(49) + 35 * ms)});
    const Gate gate = plant.judge(&soak::nodesAloneBecomeSafe);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.excused, qint64(1));
}

void tst_SafetyGates::aNodeThatWaitedForAProcessorIsExcused()
{
    for (const quint32 thread : {1U, 2U}) {  // what another thread waited for says nothing
        HandMade plant = silence(HandMade::at(49) + 44 * ms);
        Record &safe = plant.node(1).records.back();
        QCOMPARE(int(safe.kind), int(Record::Safe));
        safe.waited = 5 * ms;
        safe.thread = thread;
        QCOMPARE(plant.judge(&soak::nodesAloneBecomeSafe).excused, qint64(thread == 1 ? 1 : 0));
    }
}

void tst_SafetyGates::aStoppedNodeCannotGoSafe()
{
    HandMade plant = silence(0);
    plant.addFault(FaultKind::StopNode, 1, HandMade::at(50), HandMade::at(79));
    QCOMPARE(plant.judge(&soak::nodesAloneBecomeSafe).failed, qint64(0));
}

void tst_SafetyGates::aNodeThatMovesAfterASafeStateIsFound()
{
    HandMade plant = silence(HandMade::at(49) + 40 * ms);
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(20));
}

void tst_SafetyGates::aSafeNodeThatComputesWithASafeDriveIsFound()
{
    HandMade plant = silence(HandMade::at(49) + 40 * ms);
    for (quint64 cycle = 80; cycle < 100; ++cycle)
        plant.step(1, cycle).numbers[Record::Drive] = soak::bitsOf(soak::SafeDrive);
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(20));
}

void tst_SafetyGates::aNodeThatComputesInASafeStopIsFound()
{
    HandMade plant;
    plant.setState(Record::SafeStop, HandMade::at(50), 49);
    for (int node = 0; node < 3; ++node)
        HandMade::removeCycles(plant.node(node), node == 1 ? 52 : 51, 99);
    const Gate gate = plant.judge(&soak::nothingMovesByItself);  // cycle 50 had begun
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("Node1-life1 computes cycle 51"), textOf(gate));
}

void tst_SafetyGates::aCycleThatBeganAfterAGapAndBeforeASafeStopIsComputed()
{
    for (const quint64 last : {72, 73}) {
        HandMade plant;
        HandMade::removeCycles(plant.master(), 50, 71);
        HandMade::removeCycles(plant.master(), 73, 99);
        for (int node = 0; node < 3; ++node) {
            HandMade::removeCycles(plant.node(node), 50, 71);
            HandMade::removeCycles(plant.node(node), node == 1 ? last + 1 : 73, 99);
        }
        plant.setState(Record::SafeStop, HandMade::at(72), 49);  // cycle 72 has begun, 49 is the newest complete one
        const Gate gate = plant.judge(&soak::nothingMovesByItself);
        QCOMPARE(gate.failed, qint64(last - 72));
        if (last == 73)
            QVERIFY2(gate.examples.first().contains("Node1-life1 computes cycle 73"), textOf(gate));
    }
}

void tst_SafetyGates::cyclesOfAFormerPhaseAllowNothingInASafeStop()
{
    HandMade plant;
    const qint64 begin = plant.end() + 100 * ms;
    HandMade::add(plant.runner(), Record::Command, -1, begin - ms);
    plant.setState(Record::RealTime, begin);
    plant.setState(Record::SafeStop, begin + ms);
    plant.addStep(1, 2).time = begin + 2 * ms;
    plant.setState(Record::Off, begin + 3 * ms);
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(1));
}

void tst_SafetyGates::safeStateWithUnsafeValuesIsFound()
{
    HandMade plant;
    HandMade::add(plant.node(1), Record::Safe, 1, plant.end(), {soak::bitsOf(0.5)});
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(1));
}

void tst_SafetyGates::aNewPhaseEndsASafeState()
{
    HandMade plant = silence(HandMade::at(49) + 40 * ms);
    HandMade::add(plant.node(1), Record::Phase, 1, HandMade::at(79));
    const Gate gate = plant.judge(&soak::nothingMovesByItself);
    QVERIFY2(gate.passed(), textOf(gate));
}

void tst_SafetyGates::aMasterThatStartsByItselfIsFound()
{
    HandMade plant;
    plant.setState(Record::RealTime, plant.end() + 2 * ms);
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(1));
    HandMade::add(plant.runner(), Record::Command, -1, plant.end() + ms);
    QVERIFY(plant.judge(&soak::nothingMovesByItself).passed());
}

void tst_SafetyGates::aRestartedMasterNeedsANewCommand()
{
    HandMade plant;
    plant.evidence.masters.emplace_back();
    plant.master().name = "Master-life2";
    plant.master().life = 2;
    HandMade::add(plant.master(), Record::Born, -1, plant.end() + 10 * ms);
    plant.setState(Record::RealTime, plant.end() + 20 * ms);
    QCOMPARE(plant.judge(&soak::nothingMovesByItself).failed, qint64(1));
}

void tst_SafetyGates::waitingMasterMayResumeByItself()
{
    HandMade plant;
    plant.setState(Record::WaitingForLateSlaves, HandMade::at(50));
    plant.setState(Record::RealTime, HandMade::at(60));
    QVERIFY(plant.judge(&soak::nothingMovesByItself).passed());
}

void tst_SafetyGates::anAlarmWithoutAFaultIsFound()
{
    for (const auto &[kind, state] : {std::pair(Record::Lost, Record::Off), {Record::State, Record::SafeStop}}) {
        HandMade plant;
        HandMade::add(plant.master(), kind, kind == Record::Lost ? 1 : -1, HandMade::at(50), {quint64(state)});
        QCOMPARE(plant.judge(&soak::noFalseAlarms).failed, qint64(1));
    }
    HandMade plant;
    HandMade::add(plant.node(1), Record::Safe, 1, HandMade::at(50), {soak::bitsOf(soak::SafeDrive)});
    QCOMPARE(plant.judge(&soak::noFalseAlarms).failed, qint64(1));
}

void tst_SafetyGates::safeStateAtPhaseEndCountsAsNoAlarm()
{
    HandMade plant;
    HandMade::add(plant.node(1), Record::Safe, 1, HandMade::at(50), {soak::bitsOf(soak::SafeDrive), 1});
    QVERIFY(plant.judge(&soak::noFalseAlarms).passed());
}

void tst_SafetyGates::anAlarmOfAFaultIsExplained()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50), HandMade::at(51));
    HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(51));
    QVERIFY(plant.judge(&soak::noFalseAlarms).passed());
}

void tst_SafetyGates::theLossOfAnotherNodeIsNotExplained()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50), HandMade::at(51));
    HandMade::add(plant.master(), Record::Lost, 2, HandMade::at(51));
    QCOMPARE(plant.judge(&soak::noFalseAlarms).failed, qint64(1));
}

void tst_SafetyGates::anAlarmInAStallIsExcused()
{
    HandMade plant;
    HandMade::add(plant.node(1), Record::Safe, 1, HandMade::at(50), {soak::bitsOf(soak::SafeDrive)});
    HandMade::add(plant.runner(), Record::Stall, -1, HandMade::at(50), {quint64(HandMade::at(46))});
    QCOMPARE(plant.judge(&soak::noFalseAlarms).excused, qint64(1));
}

void tst_SafetyGates::lossIsJudgedAtTheNodeThatDetectedItFirst()
{
    for (const quint64 isWanted : {0, 1}) {
        HandMade plant;
        HandMade::add(plant.node(1), Record::Safe, 1, HandMade::at(50), {soak::bitsOf(soak::SafeDrive), isWanted});
        HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(51));
        const Gate gate = plant.judge(&soak::noFalseAlarms);
        QCOMPARE(gate.failed, qint64(1));
        QVERIFY2(gate.examples.constFirst().contains(isWanted == 0 ? "safe state" : "is lost"), textOf(gate));
    }
}

void tst_SafetyGates::unreportedSafeStopIsFound()
{
    QVERIFY(!HandMade().judge(&soak::safeStopsAreTold).isAsked);
    for (const bool isTold : {false, true}) {
        HandMade plant(400);
        HandMade::add(plant.node(1), Record::Safe, 1, HandMade::at(150), {soak::bitsOf(soak::SafeDrive), 0, 1});
        if (isTold)
            plant.setState(Record::SafeStop, HandMade::at(152));
        QCOMPARE(plant.judge(&soak::safeStopsAreTold).passed(), isTold);
    }
}

void tst_SafetyGates::anEvictedNodeThatStaysOutPasses()
{
    QVERIFY(!HandMade().judge(&soak::evictedNodesStayOut).isAsked);
    const Gate gate = eviction().judge(&soak::evictedNodesStayOut);
    QVERIFY2(gate.isAsked && gate.passed() && gate.looked == 1, textOf(gate));
}

void tst_SafetyGates::anEvictedNodeThatRegistersIsFound()
{
    HandMade plant = eviction();
    HandMade::add(plant.master(), Record::Registered, 1, HandMade::at(60));
    QCOMPARE(plant.judge(&soak::evictedNodesStayOut).failed, 1);
}

void tst_SafetyGates::anEvictedNodeThatMovesIsFound()
{
    HandMade plant = eviction();
    plant.addStep(1, 60);
    QCOMPARE(plant.judge(&soak::evictedNodesStayOut).failed, 1);
}

void tst_SafetyGates::aStartWithoutAnEvictedNodeIsFound()
{
    HandMade plant = eviction();
    plant.setState(Record::RealTime, HandMade::at(60));
    QCOMPARE(plant.judge(&soak::evictedNodesStayOut).failed, 1);
}

void tst_SafetyGates::aNewMasterKeepsNobodyOut()
{
    HandMade plant = eviction();
    HandMade::add(plant.runner(), Record::Started, -1, HandMade::at(55), {0, 2});
    HandMade::add(plant.master(), Record::Registered, 1, HandMade::at(60));
    const Gate gate = plant.judge(&soak::evictedNodesStayOut);
    QVERIFY2(gate.passed(), textOf(gate));
}

QTEST_APPLESS_MAIN(tst_SafetyGates)
#include "tst_SafetyGates.moc"

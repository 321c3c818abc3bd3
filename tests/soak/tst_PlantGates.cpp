// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include <QtTest/QtTest>

using soak::FaultKind;
using soak::Gate;
using soak::Record;

class tst_PlantGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cyclesOfAGoodPlantAddUp();
    void skippedCyclesThatAreCountedAddUp();
    void skippedCyclesThatAreNotCountedAreFound();
    void aCycleThatWasCountedAndNeverComputedIsFound();
    void aGridThatDriftsIsFound();
    void lateCycleRecordOfAStoppedMasterIsAccepted();
    void aPhaseThatWasCutOffIsJudgedByItsGridAlone();
    void faultReportedInTimePasses();
    void faultReportedTooLateIsFound();
    void lossReportIsTimedFromTheEndOfTheProcess();
    void cutLinkIsJudgedInTheLifeThatIsCut();
    void unreportedFaultIsFound();
    void lateReportDuringAMachineStallIsExcused();
    void nodeStalledByTheMachineBeforeIsExcused();
    void nodeThatReturnsInTimePasses();
    void nodeThatReturnsTooLateIsFound();
    void nodeThatNeverReturnsIsFound();
    void aPlantThatNeverRunsAgainIsFound();
    void datagramsThatAreCountedPass();
    void aDatagramThatIsNotCountedIsFound();
    void aFaultInTheFirstMomentsOfAPhaseIsCountedToo();
    void unreportedRefusalIsFound();
    void aNodeThatIsLostTwiceIsFound();
    void aDescriptorThatLeaksIsFound();
    void connectionBeingOpenedIsNotCountedAsLeak();
    void aThreadThatLeaksIsFound();
    void memoryIsComparedWithinOneLife();
    void memoryThatGrowsIsFound();
    void memoryThatStaysPasses();
    void aLeakInsideOfTheReserveIsFound();
    void fluctuatingHeapPasses();
    void theHeapIsJudgedInTheWindowOfTheMemory();
    void missingHeapRecordIsFound();
    void memoryIsNotJudgedInAShortRun();
};

namespace {

constexpr qint64 ms = HandMade::Millisecond;
constexpr quint64 InUse = 8'000 * 1024;  // [byte]

HandMade withStrangers(quint64 counted)
{
    HandMade plant;
    HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::Counters; });
    plant.addCounters(40, 0, 7, HandMade::at(40));
    plant.addFault(FaultKind::GarbageDatagrams, -1, HandMade::at(41), HandMade::at(44), 100);
    plant.addCounters(60, 0, 7 + counted, HandMade::at(60));
    plant.addCounters(100, 0, 7 + counted, plant.end());
    return plant;
}

/// The master is looked at each tenth of a minute, sixty times, and uses \a growth [kB] more in ten
/// minutes; what it has in use of its heap stays. The last four looks see what is said here.
HandMade withUsage(quint64 descriptors, quint64 threads, quint64 growth = 0, quint32 lastLife = 1)
{
    HandMade plant;
    for (quint64 i = 0; i < 60; ++i) {
        const bool isLast = i >= 56;
        HandMade::add(
            plant.runner(), Record::Usage, -1, HandMade::at(0) + qint64(i) * 6'000 * ms,
            {isLast ? descriptors : 40, isLast ? threads : 2, 10'000 + i * growth / 100, isLast ? lastLife : 1, 1});
        HandMade::add(plant.master(), Record::Heap, -1, HandMade::at(0) + qint64(i) * 6'000 * ms, {InUse, 2 * InUse});
    }
    return plant;
}

/// Node 1 is killed in cycle 50; its next life does its first step at \a back (0: never).
HandMade withRestart(qint64 back)
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50), HandMade::at(51));
    HandMade::removeCycles(plant.node(1), 51, 99);
    plant.addLife(1, 2, HandMade::at(52));
    if (back > 0)
        plant.addStep(1, 99).time = back;
    return plant;
}

}  // namespace

void tst_PlantGates::cyclesOfAGoodPlantAddUp()
{
    HandMade plant;
    const Gate gate = plant.judge(&soak::cyclesAddUp);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["cycles"], 100.0);
    QCOMPARE(gate.figures["skipped"], 0.0);
}

void tst_PlantGates::skippedCyclesThatAreCountedAddUp()
{
    HandMade plant;
    HandMade::removeCycles(plant.master(), 50, 54);
    plant.addCounters(95, 5);
    const Gate gate = plant.judge(&soak::cyclesAddUp);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["skipped"], 5.0);
}

void tst_PlantGates::skippedCyclesThatAreNotCountedAreFound()
{
    HandMade plant;
    HandMade::removeCycles(plant.master(), 50, 54);
    plant.addCounters(95, 4);
    QCOMPARE(plant.judge(&soak::cyclesAddUp).failed, qint64(1));
}

void tst_PlantGates::aCycleThatWasCountedAndNeverComputedIsFound()
{
    HandMade plant;
    HandMade::removeCycles(plant.master(), 50, 50);  // counted as computed
    QCOMPARE(plant.judge(&soak::cyclesAddUp).failed, qint64(1));
}

void tst_PlantGates::aGridThatDriftsIsFound()
{
    HandMade plant;
    for (Record &record : plant.master().records) {
        if (record.kind == Record::Cycle)
            record.time += qint64(record.cycle) * HandMade::Period / 50;  // 2 %
    }
    QCOMPARE(plant.judge(&soak::cyclesAddUp).failed, qint64(1));
}

void tst_PlantGates::lateCycleRecordOfAStoppedMasterIsAccepted()
{
    for (const bool isOnPurpose : {false, true}) {
        HandMade plant;
        HandMade::removeCycles(plant.master(), 81, 99);
        HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::Counters; });
        for (Record &record : plant.master().records) {
            if (record.kind == Record::Cycle && record.cycle == 80)
                record.time += 150 * ms;
        }
        if (isOnPurpose)
            plant.addFault(FaultKind::StopMaster, -1, HandMade::at(79), HandMade::at(80) + 150 * ms);
        QCOMPARE(plant.judge(&soak::cyclesAddUp).passed(), isOnPurpose);
    }
}

void tst_PlantGates::aPhaseThatWasCutOffIsJudgedByItsGridAlone()
{
    HandMade plant;
    HandMade::remove(plant.master(), [&](const Record &record) { return record.time > plant.end(); });
    plant.addCounters(97, 0);  // the master was killed after this
    const Gate gate = plant.judge(&soak::cyclesAddUp);
    QVERIFY2(gate.passed(), textOf(gate));
}

void tst_PlantGates::faultReportedInTimePasses()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50) + ms, HandMade::at(51));
    HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(55) + ms);
    const Gate gate = plant.judge(&soak::faultsAreSeen);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["kill a node [cycles]"], 5.0);
}

void tst_PlantGates::faultReportedTooLateIsFound()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50) + ms, HandMade::at(51));
    HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(57) + ms);
    QCOMPARE(plant.judge(&soak::faultsAreSeen).failed, qint64(1));
}

void tst_PlantGates::lossReportIsTimedFromTheEndOfTheProcess()
{
    for (const int cycle : {84, 87}) {
        HandMade plant(100);
        HandMade::add(plant.runner(), Record::Gone, 1, HandMade::at(80) + ms);
        plant.addFault(FaultKind::KillNode, 1, HandMade::at(50) + ms, HandMade::at(81));
        HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(cycle) + ms);
        const Gate gate = plant.judge(&soak::faultsAreSeen);
        QCOMPARE(gate.failed, qint64(cycle == 87));
        QCOMPARE(gate.figures["kill a node [cycles]"], double(cycle - 80));
    }
}

void tst_PlantGates::cutLinkIsJudgedInTheLifeThatIsCut()
{
    // The life before it computes once more after the fault has begun, and the next one begins 150
    // ms later.
    HandMade plant(100);
    HandMade::removeCycles(plant.node(1), 41, 99);
    plant.addLife(1, 2, HandMade::at(50));
    for (quint64 cycle = 55; cycle < 70; ++cycle)
        plant.addStep(1, cycle);
    HandMade::add(plant.master(), Record::Late, 1, HandMade::at(72));
    plant.addFault(FaultKind::CutLink, 1, HandMade::at(40), HandMade::at(90));
    const Gate gate = plant.judge(&soak::faultsAreSeen);
    QVERIFY2(gate.passed(), textOf(gate));
}

void tst_PlantGates::unreportedFaultIsFound()
{
    HandMade plant;
    plant.addFault(FaultKind::StopNode, 1, HandMade::at(50), HandMade::at(51));
    HandMade::add(plant.master(), Record::Late, 2, HandMade::at(51));  // of another node
    const Gate gate = plant.judge(&soak::faultsAreSeen);
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("nobody was told of: stop a node (Node1)"), textOf(gate));
}

void tst_PlantGates::lateReportDuringAMachineStallIsExcused()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50) + ms, HandMade::at(51));
    HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(57) + ms).waited = 15 * ms;
    QCOMPARE(plant.judge(&soak::faultsAreSeen).excused, qint64(1));
}

void tst_PlantGates::nodeStalledByTheMachineBeforeIsExcused()
{
    HandMade plant;
    plant.addFault(FaultKind::KillNode, 1, HandMade::at(50), HandMade::at(51));
    HandMade::add(plant.runner(), Record::Stall, -1, HandMade::at(45), {quint64(HandMade::at(42))});
    QCOMPARE(plant.judge(&soak::faultsAreSeen).excused, qint64(1));
    QCOMPARE(plant.judge(&soak::faultsAreCounted).excused, qint64(1));
}

void tst_PlantGates::nodeThatReturnsInTimePasses()
{
    HandMade plant = withRestart(HandMade::at(99));
    const Gate gate = plant.judge(&soak::plantRecovers);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["longest [ms]"], 480.0);
}

void tst_PlantGates::nodeThatReturnsTooLateIsFound()
{
    HandMade plant = withRestart(HandMade::at(51) + 2001 * ms);
    QCOMPARE(plant.judge(&soak::plantRecovers).failed, qint64(1));
}

void tst_PlantGates::nodeThatNeverReturnsIsFound()
{
    HandMade plant = withRestart(0);
    QCOMPARE(plant.judge(&soak::plantRecovers).failed, qint64(1));
}

void tst_PlantGates::aPlantThatNeverRunsAgainIsFound()
{
    HandMade plant;
    HandMade::add(plant.runner(), Record::FaultBegins, -1, plant.end() + 600 * ms, {quint64(FaultKind::KillMaster), 1});
    QCOMPARE(plant.judge(&soak::plantRecovers).failed, qint64(1));
}

void tst_PlantGates::datagramsThatAreCountedPass()
{
    HandMade plant = withStrangers(100);
    const Gate gate = plant.judge(&soak::faultsAreCounted);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["garbage datagrams counted"], 100.0);
}

void tst_PlantGates::aDatagramThatIsNotCountedIsFound()
{
    for (const quint64 counted : {99U, 101U}) {
        HandMade plant = withStrangers(counted);
        QCOMPARE(plant.judge(&soak::faultsAreCounted).failed, qint64(1));
    }
}

void tst_PlantGates::aFaultInTheFirstMomentsOfAPhaseIsCountedToo()
{
    for (const quint64 counted : {99U, 100U}) {  // nobody has looked at the counters of this phase before
        HandMade plant;
        HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::Counters; });
        plant.addFault(FaultKind::GarbageDatagrams, -1, HandMade::at(1), HandMade::at(4), 100);
        plant.addCounters(60, 0, counted, HandMade::at(60));
        QCOMPARE(plant.judge(&soak::faultsAreCounted).passed(), counted == 100);
    }
}

void tst_PlantGates::unreportedRefusalIsFound()
{
    for (const int told : {7, 8}) {
        HandMade plant;
        plant.addFault(FaultKind::GarbageControl, -1, HandMade::at(50), HandMade::at(51), 8);
        for (int i = 0; i < told; ++i)
            HandMade::add(plant.master(), Record::Refused, -1, HandMade::at(51));
        QCOMPARE(plant.judge(&soak::faultsAreCounted).passed(), told == 8);
    }
}

void tst_PlantGates::aNodeThatIsLostTwiceIsFound()
{
    for (const int told : {1, 2}) {
        HandMade plant;
        plant.addFault(FaultKind::KillNode, 1, HandMade::at(50), HandMade::at(51));
        for (int i = 0; i < told; ++i)
            HandMade::add(plant.master(), Record::Lost, 1, HandMade::at(51));
        QCOMPARE(plant.judge(&soak::faultsAreCounted).passed(), told == 1);
    }
}

void tst_PlantGates::aDescriptorThatLeaksIsFound()
{
    HandMade good = withUsage(40, 2);
    QVERIFY(good.judge(&soak::nothingLeaks).passed());
    HandMade bad = withUsage(41, 2);
    QCOMPARE(bad.judge(&soak::nothingLeaks).failed, qint64(1));
}

void tst_PlantGates::connectionBeingOpenedIsNotCountedAsLeak()
{
    HandMade plant = withUsage(40, 2);
    for (const int place : {2, 59})
        plant.runner().records[std::size_t(place)].numbers[Record::Descriptors] = 46;
    QVERIFY(plant.judge(&soak::nothingLeaks).passed());
}

void tst_PlantGates::aThreadThatLeaksIsFound()
{
    HandMade plant = withUsage(40, 3);
    QCOMPARE(plant.judge(&soak::nothingLeaks).failed, qint64(1));
}

void tst_PlantGates::memoryIsComparedWithinOneLife()
{
    HandMade plant = withUsage(41, 2, 0, 2);
    QVERIFY(plant.judge(&soak::nothingLeaks).passed());
}

namespace {

Gate judgeMemory(HandMade plant, bool isLong = true)
{
    soak::Profile profile;
    profile.judgesMemory = isLong;
    return plant.judge([&](const soak::Evidence &evidence) { return soak::memoryStays(evidence, profile); });
}

/// Resident memory stays.
/// \param more  [kB] of the heap that are in use in addition at a look, by its number
template<typename More>
HandMade withHeap(More more)
{
    HandMade plant = withUsage(40, 2);
    quint64 i = 0;
    for (Record &record : plant.master().records) {
        if (record.kind == Record::Heap)
            record.numbers[Record::HeapInUse] += quint64(more(i++)) * 1024;
    }
    return plant;
}

}  // namespace

void tst_PlantGates::memoryThatGrowsIsFound()
{
    const Gate gate = judgeMemory(withUsage(40, 2, 120));
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(qAbs(gate.figures["largest growth [kB per 10 min]"] - 120.0) < 3.0, textOf(gate));
}

void tst_PlantGates::memoryThatStaysPasses()
{
    const Gate gate = judgeMemory(withUsage(40, 2, 80));
    QVERIFY2(gate.passed(), textOf(gate));
}

void tst_PlantGates::aLeakInsideOfTheReserveIsFound()
{
    const Gate gate = judgeMemory(withHeap([](quint64 i) { return i * 120 / 100; }));
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().startsWith("the heap in use of the master, life 1 grows by"), textOf(gate));
    QVERIFY2(qAbs(gate.figures["growth of the master's heap in use [kB per 10 min]"] - 120.0) < 3.0, textOf(gate));
    QCOMPARE(gate.figures["largest growth [kB per 10 min]"], 0.0);
    const Gate below = judgeMemory(withHeap([](quint64 i) { return i * 80 / 100; }));
    QVERIFY2(below.passed(), textOf(below));
}

void tst_PlantGates::fluctuatingHeapPasses()
{
    const Gate gate = judgeMemory(withHeap([](quint64 i) { return i % 2 * 400; }));  // nodes come and go
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(2));
    QCOMPARE(gate.figures["master heap in use [kB]"], 8400.0);
}

void tst_PlantGates::theHeapIsJudgedInTheWindowOfTheMemory()
{
    // Half a minute of warm-up are five looks.
    const Gate warmUp = judgeMemory(withHeap([](quint64 i) { return i < 5 ? 0 : 4000; }));
    QVERIFY2(warmUp.passed(), textOf(warmUp));
    const Gate later = judgeMemory(withHeap([](quint64 i) { return i < 7 ? 0 : 4000; }));
    QCOMPARE(later.failed, qint64(1));
}

void tst_PlantGates::missingHeapRecordIsFound()
{
    HandMade plant = withUsage(40, 2);
    HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::Heap; });
    const Gate gate = judgeMemory(plant);
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("has not written what it has in use"), textOf(gate));
}

void tst_PlantGates::memoryIsNotJudgedInAShortRun()
{
    QVERIFY(!judgeMemory(withUsage(40, 2, 120), false).isAsked);
}

QTEST_APPLESS_MAIN(tst_PlantGates)
#include "tst_PlantGates.moc"

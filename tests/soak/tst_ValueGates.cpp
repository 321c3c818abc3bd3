// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include <QtTest/QtTest>

using soak::Gate;
using soak::Record;

// A checker that cannot fail proves nothing: each gate is seen with a good history, and failing
// with one that is spoilt in one place.
class tst_ValueGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aGoodHistoryPasses();
    void aMixedValueIsFound();
    void unwrittenGroupCountsAsConsistent();
    void valueWithoutAWriterIsFound();
    void valueOfANonexistentLifeIsFound();
    void anOlderValueAfterANewerOneIsFound();
    void aValueOfAnEarlierLifeAfterALaterOneIsFound();
    void emptyValueAfterAWrittenOneIsFound();
    void safeValueIsNotAnOlderValue();
    void emptyValueAtPhaseStartIsAccepted();
    void heldValueIsAccepted();
    void aStepThatComesTwiceIsFound();
    void unreportedMissedCyclesAreFound();
    void reportedMissedCyclesPass();
    void gateWithoutEvidenceDoesNotPass();
};

void tst_ValueGates::aGoodHistoryPasses()
{
    HandMade plant;
    for (Gate (*gate)(const soak::Evidence &) :
         {&soak::valuesAreWhole, &soak::valuesWereWritten, &soak::valuesNeverGoBack, &soak::stepsComeOnce}) {
        const Gate judged = plant.judge(gate);
        QVERIFY2(judged.passed(), textOf(judged));
        QCOMPARE(judged.looked, qint64(300));
    }
}

void tst_ValueGates::aMixedValueIsFound()
{
    HandMade plant;
    plant.step(1, 50).numbers[Record::ComputedCheck] ^= 1;
    const Gate gate = plant.judge(&soak::valuesAreWhole);
    QCOMPARE(gate.failed, qint64(1));
    QVERIFY2(gate.examples.first().contains("Node1-life1, cycle 50"), textOf(gate));
}

void tst_ValueGates::unwrittenGroupCountsAsConsistent()
{
    HandMade plant;
    for (const auto &[cycle, drive] : {std::pair(quint64(10), 0.0), {11, soak::SafeDrive}, {12, 0.5}}) {
        Record &step = plant.step(1, cycle);
        step.numbers[Record::SeenLife] = step.numbers[Record::SeenCounter] = step.numbers[Record::SeenCheck] = 0;
        step.numbers[Record::ComputedCheck] = soak::checkOfNothing(plant.evidence.shape, 0, drive);
    }
    const Gate gate = plant.judge(&soak::valuesAreWhole);
    QCOMPARE(gate.failed, qint64(1));  // a drive that is neither 0 nor safe has been written by somebody
    QVERIFY2(gate.examples.first().contains("cycle 12"), textOf(gate));
}

void tst_ValueGates::valueWithoutAWriterIsFound()
{
    HandMade plant;
    Record &step = plant.step(1, 50);
    step.numbers[Record::SeenCheck] ^= 1;  // whole, and yet not what its writer wrote
    step.numbers[Record::ComputedCheck] = step.numbers[Record::SeenCheck];
    QVERIFY(plant.judge(&soak::valuesAreWhole).passed());
    QCOMPARE(plant.judge(&soak::valuesWereWritten).failed, qint64(1));
}

void tst_ValueGates::valueOfANonexistentLifeIsFound()
{
    HandMade plant;
    plant.step(1, 99).numbers[Record::SeenLife] = 2;
    QCOMPARE(plant.judge(&soak::valuesWereWritten).failed, qint64(1));
}

void tst_ValueGates::anOlderValueAfterANewerOneIsFound()
{
    HandMade plant;
    plant.step(1, 50).numbers[Record::SeenCounter] -= 2;
    QCOMPARE(plant.judge(&soak::valuesNeverGoBack).failed, qint64(1));
}

void tst_ValueGates::aValueOfAnEarlierLifeAfterALaterOneIsFound()
{
    HandMade plant;
    Record &step = plant.step(1, 50);
    step.numbers[Record::SeenLife] = 2;
    step.numbers[Record::SeenCounter] = 1;
    QCOMPARE(plant.judge(&soak::valuesNeverGoBack).failed, qint64(49));  // all of life 1 that follow
}

void tst_ValueGates::emptyValueAfterAWrittenOneIsFound()
{
    HandMade plant;
    plant.step(1, 50).numbers[Record::SeenLife] = 0;
    QCOMPARE(plant.judge(&soak::valuesNeverGoBack).failed, qint64(1));
}

void tst_ValueGates::safeValueIsNotAnOlderValue()
{
    HandMade plant;
    plant.step(1, 50).numbers[Record::SeenLife] = 0;
    plant.step(1, 50).numbers[Record::Drive] = soak::bitsOf(soak::SafeDrive);
    QVERIFY(plant.judge(&soak::valuesNeverGoBack).passed());
}

void tst_ValueGates::emptyValueAtPhaseStartIsAccepted()
{
    HandMade plant;
    plant.step(1, 0).numbers[Record::SeenLife] = plant.step(1, 0).numbers[Record::SeenCounter] = 0;
    QVERIFY(plant.judge(&soak::valuesNeverGoBack).passed());
}

void tst_ValueGates::heldValueIsAccepted()
{
    HandMade plant;
    plant.step(1, 50).numbers[Record::SeenCounter] -= 1;
    QVERIFY(plant.judge(&soak::valuesNeverGoBack).passed());
}

void tst_ValueGates::aStepThatComesTwiceIsFound()
{
    HandMade plant;
    plant.addStep(1, 50);
    QCOMPARE(plant.judge(&soak::stepsComeOnce).failed, qint64(1));
}

void tst_ValueGates::unreportedMissedCyclesAreFound()
{
    HandMade plant;
    HandMade::removeCycles(plant.node(1), 50, 51);
    QCOMPARE(plant.judge(&soak::stepsComeOnce).failed, qint64(1));
}

void tst_ValueGates::reportedMissedCyclesPass()
{
    HandMade plant;
    HandMade::removeCycles(plant.node(1), 50, 51);
    plant.step(1, 52).numbers[Record::Missed] = 2;
    const Gate gate = plant.judge(&soak::stepsComeOnce);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.figures["missed"], 2.0);
}

void tst_ValueGates::gateWithoutEvidenceDoesNotPass()
{
    HandMade plant(0);
    QVERIFY(!plant.judge(&soak::valuesAreWhole).passed());
    QVERIFY(!plant.judge(&soak::valuesWereWritten).passed());
    QVERIFY(!plant.judge(&soak::cyclesAddUp).passed());
}

QTEST_APPLESS_MAIN(tst_ValueGates)
#include "tst_ValueGates.moc"

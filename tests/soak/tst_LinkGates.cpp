// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include "signals/Fnv1a.h"
#include "transport/FaultInjector.h"

#include <QtTest/QtTest>

using qplc::FaultInjector;
using soak::FaultKind;
using soak::Gate;
using soak::Record;

class tst_LinkGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void countedLinkFaultsPass_data();
    void countedLinkFaultsPass();
    void wrongFaultCountIsFound_data() { countedLinkFaultsPass_data(); }
    void wrongFaultCountIsFound();
    void cyclesThatTheNodeMissedMayBeAmongTheLost();
    void framesUnderWayMayBeCountedOrNot();
    void lossesAreCountedWhenTheNextAnswerArrives();
    void everyLostFrameMustCountAsLate();
    void countersOfTwoPhasesAreNotJudged();
    void aNodeThatRegisteredTwiceIsNotJudged();
    void countersOfALaterLifeAreNotUsedForAnEarlierFault();

private:
    static constexpr int Frames = 80;
    static constexpr quint64 Seed = 11;

    /// Node 2 runs with a bad link; the master counts at the end of cycle 80, long after the last
    /// frame.
    static HandMade badLink(FaultKind kind, Record::NodeNumber number, quint64 counted, quint64 seed = Seed)
    {
        HandMade plant(Frames);
        const qint64 begin = HandMade::at(0) - 900 * HandMade::Millisecond;
        HandMade::add(plant.runner(), Record::FaultBegins, 2, begin, {quint64(kind), 700, seed});
        HandMade::add(plant.runner(), Record::FaultEnds, 2, plant.end() + 90 * HandMade::Millisecond,
                      {quint64(kind), 700});
        addCounters(plant, number, counted, plant.end() + 50 * HandMade::Millisecond);
        return plant;
    }
    static void addCounters(HandMade &plant, Record::NodeNumber number, quint64 counted, qint64 time, quint64 phase = 1)
    {
        Record &record = HandMade::add(plant.master(), Record::NodeCounters, 2, time, {phase});
        record.numbers[Record::NodeLate] = Frames;
        record.numbers[number] = counted;
    }
    /// What the seed does to that many frames.
    static quint64 done(FaultKind kind, FaultInjector::Kind what, int frames, quint64 seed = Seed)
    {
        QString error;
        const auto plan = qplc::FaultPlan::fromText(soak::linkFaultsOf(kind, seed), &error);
        FaultInjector injector(plan->sent, seed, 2 * qplc::fnv1a64("Node2"));
        for (int i = 0; i < frames; ++i)
            injector.decide(0);
        return injector.count(what);
    }
};

void tst_LinkGates::countedLinkFaultsPass_data()
{
    QTest::addColumn<int>("fault");
    QTest::addColumn<int>("what");
    QTest::addColumn<int>("number");
    QTest::newRow("lost") << int(FaultKind::LoseFrames) << int(FaultInjector::Lost) << int(Record::AnswersLost);
    QTest::newRow("duplicated") << int(FaultKind::DuplicateFrames) << int(FaultInjector::Duplicated)
                                << int(Record::Duplicated);
    QTest::newRow("reordered") << int(FaultKind::ReorderFrames) << int(FaultInjector::Reordered)
                               << int(Record::Reordered);
    QTest::newRow("corrupted") << int(FaultKind::CorruptFrames) << int(FaultInjector::Corrupted)
                               << int(Record::Rejected);
}

void tst_LinkGates::countedLinkFaultsPass()
{
    QFETCH(int, fault);
    QFETCH(int, what);
    QFETCH(int, number);
    const quint64 expected = done(FaultKind(fault), FaultInjector::Kind(what), Frames);
    QVERIFY(expected > 2);
    HandMade plant = badLink(FaultKind(fault), Record::NodeNumber(number), expected);
    const Gate gate = plant.judge(&soak::linkFaultsAreCounted);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(1));
}

void tst_LinkGates::wrongFaultCountIsFound()
{
    QFETCH(int, fault);
    QFETCH(int, what);
    QFETCH(int, number);
    for (const int error : {-1, 1}) {
        const quint64 counted = done(FaultKind(fault), FaultInjector::Kind(what), Frames) + quint64(error);
        HandMade plant = badLink(FaultKind(fault), Record::NodeNumber(number), counted);
        QCOMPARE(plant.judge(&soak::linkFaultsAreCounted).failed, qint64(1));
    }
}

void tst_LinkGates::cyclesThatTheNodeMissedMayBeAmongTheLost()
{
    const quint64 expected = done(FaultKind::LoseFrames, FaultInjector::Lost, Frames);
    for (const quint64 missed : {2U, 3U}) {
        HandMade plant = badLink(FaultKind::LoseFrames, Record::AnswersLost, expected + 3);
        plant.step(2, 10).numbers[Record::Missed] = missed;
        QCOMPARE(plant.judge(&soak::linkFaultsAreCounted).passed(), missed == 3);
    }
}

void tst_LinkGates::framesUnderWayMayBeCountedOrNot()
{
    // Between the reading of the counters and three cycles before it lies a duplicate: both numbers
    // are right.
    const auto of = [](int frames) { return done(FaultKind::DuplicateFrames, FaultInjector::Duplicated, frames); };
    int frames = 10;
    while (of(frames + 3) == of(frames))
        ++frames;
    const quint64 least = of(frames), most = of(frames + 3);
    for (quint64 counted = least - 1; counted <= most + 1; ++counted) {
        HandMade plant = badLink(FaultKind::DuplicateFrames, Record::Duplicated, counted);
        HandMade::removeCycles(plant.node(2), quint64(frames + 3), Frames);
        HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::NodeCounters; });
        addCounters(plant, Record::Duplicated, counted, HandMade::at(quint64(frames + 2)) + 2 * HandMade::Millisecond);
        QCOMPARE(plant.judge(&soak::linkFaultsAreCounted).passed(), counted >= least && counted <= most);
    }
}

void tst_LinkGates::aNodeThatRegisteredTwiceIsNotJudged()
{
    HandMade plant
        = badLink(FaultKind::LoseFrames, Record::AnswersLost, 0);  // what was counted went with the first registration
    HandMade::add(plant.master(), Record::Registered, 2, HandMade::at(0) - 100 * HandMade::Millisecond);
    HandMade::add(plant.master(), Record::Registered, 2, HandMade::at(70));
    const Gate gate = plant.judge(&soak::linkFaultsAreCounted);
    QCOMPARE(gate.failed, qint64(0));
    QCOMPARE(gate.looked, qint64(0));
}

void tst_LinkGates::lossesAreCountedWhenTheNextAnswerArrives()
{
    // The last four frames before the reading are lost, and the first of them is not under way any
    // more.
    const auto lost
        = [](int frames, quint64 seed) { return done(FaultKind::LoseFrames, FaultInjector::Lost, frames, seed); };
    quint64 seed = 1;
    while (lost(Frames, seed) - lost(Frames - 4, seed) < 4 || lost(Frames - 5, seed) < lost(Frames - 4, seed))
        ++seed;
    const quint64 before = lost(Frames - 4, seed);
    for (const int error : {-1, 0}) {
        HandMade plant = badLink(FaultKind::LoseFrames, Record::AnswersLost, 0, seed);
        HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::NodeCounters; });
        addCounters(plant, Record::AnswersLost, before + quint64(error), HandMade::at(Frames - 1) + 2'000'000);
        QCOMPARE(plant.judge(&soak::linkFaultsAreCounted).passed(), error == 0);
    }
}

void tst_LinkGates::everyLostFrameMustCountAsLate()
{
    const quint64 expected = done(FaultKind::LoseFrames, FaultInjector::Lost, Frames);
    for (const quint64 late : {expected - 1, expected}) {
        HandMade plant = badLink(FaultKind::LoseFrames, Record::AnswersLost, expected);
        for (Record &record : plant.master().records) {
            if (record.kind == Record::NodeCounters)
                record.numbers[Record::NodeLate] = late;
        }
        QCOMPARE(plant.judge(&soak::linkFaultsAreCounted).passed(), late == expected);
    }
}

void tst_LinkGates::countersOfTwoPhasesAreNotJudged()
{
    HandMade plant = badLink(FaultKind::LoseFrames, Record::AnswersLost, 0);
    addCounters(plant, Record::AnswersLost, 3, plant.end() + 60 * HandMade::Millisecond, 2);
    const Gate gate = plant.judge(&soak::linkFaultsAreCounted);
    QCOMPARE(gate.looked, qint64(0));
    QVERIFY(gate.isAsked && !gate.passed());
}

void tst_LinkGates::countersOfALaterLifeAreNotUsedForAnEarlierFault()
{
    HandMade plant = badLink(FaultKind::CorruptFrames, Record::Rejected,
                             done(FaultKind::CorruptFrames, FaultInjector::Corrupted, Frames));
    plant.addLife(2, 2, plant.end() + 55 * HandMade::Millisecond);
    addCounters(plant, Record::Rejected, 0, plant.end() + 60 * HandMade::Millisecond);
    const Gate gate = plant.judge(&soak::linkFaultsAreCounted);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(1));
}

QTEST_APPLESS_MAIN(tst_LinkGates)
#include "tst_LinkGates.moc"

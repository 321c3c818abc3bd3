// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/SafetyGuard.h"

#include <QtTest/QtTest>

using namespace qplc;

// The limits of a phase: what leads to a safe stop, and what does not.
class tst_SafetyGuard : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void fiveConsecutiveLateAnswersTripTheGuard();
    void answersInTimeEmptyTheBucket();
    void onlyCriticalNodesTripByLateAnswers();
    void safeStopPolicyTripsAtTheFirstLateAnswer();
    void aGapTripsAndSmallerOnesDoNot();
    void aSleepOfTheComputerIsAGap();
    void overrunsInARowTripAndSingleOnesDoNot();
    void aWaitTripsWhenItIsTooLong();
    void withoutLimitsNothingTrips();
    void firstReasonIsReportedOnce();
    void reasonIsReportedDespiteAFullQueue();

private:
    static QVector<CycleEvent> taken(CycleReports &reports)
    {
        QVector<CycleEvent> events;
        reports.take([&](const CycleEvent &event) { events << event; }, [](const TappedFrame &) {});
        return events;
    }
    static CycleClock::Tick tick(quint64 cycle, qint64 lateness = 0, quint64 skipped = 0)
    {
        CycleClock::Tick tick;
        tick.cycle = cycle;
        tick.lateness = lateness;
        tick.skipped = skipped;
        tick.overrun = skipped > 0;
        return tick;
    }
    static constexpr qint64 Period = 10'000'000;
};

void tst_SafetyGuard::fiveConsecutiveLateAnswersTripTheGuard()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({});
    NodeSlot slot;
    slot.id = 7;
    slot.critical = true;
    for (quint64 cycle = 1; cycle <= 4; ++cycle) {
        guard.answeredLate(slot, cycle);
        QVERIFY(!guard.isTripped());
    }
    guard.answeredLate(slot, 5);
    QVERIFY(guard.isTripped());
    const QVector<CycleEvent> events = taken(reports);
    QCOMPARE(events.size(), 1);
    QCOMPARE(events.at(0).kind, CycleEvent::TrippedByLateAnswers);
    QCOMPARE(events.at(0).node, quint16(7));
    QCOMPARE(events.at(0).cycle, quint64(5));
}

void tst_SafetyGuard::answersInTimeEmptyTheBucket()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({});
    NodeSlot slot;
    slot.critical = true;
    for (int round = 0; round < 100; ++round) {  // one of three is late: the bucket never fills
        guard.answeredLate(slot, quint64(round));
        guard.answeredInTime(slot);
        guard.answeredInTime(slot);
    }
    QVERIFY(!guard.isTripped());
    QCOMPARE(slot.bucket.load(), 0);
    for (int round = 0; round < 8; ++round) {  // one of two fills it, slowly
        guard.answeredLate(slot, quint64(round));
        guard.answeredInTime(slot);
    }
    QVERIFY(!guard.isTripped());
    guard.answeredLate(slot, 9);
    QVERIFY(guard.isTripped());
}

void tst_SafetyGuard::onlyCriticalNodesTripByLateAnswers()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({});
    NodeSlot slot;
    for (quint64 cycle = 0; cycle < 1000; ++cycle)
        guard.answeredLate(slot, cycle);
    QVERIFY(!guard.isTripped());
    QCOMPARE(slot.bucket.load(), SafetyGuard::BucketLimit);  // and it takes no longer to empty
}

void tst_SafetyGuard::safeStopPolicyTripsAtTheFirstLateAnswer()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({});
    NodeSlot slot;
    slot.policy = QPlcSlaveNode::SafeStopWhenLate;
    guard.answeredInTime(slot);
    QVERIFY(!guard.isTripped());
    guard.answeredLate(slot, 3);
    QVERIFY(guard.isTripped());
    QCOMPARE(taken(reports).at(0).kind, CycleEvent::TrippedByLateAnswer);
}

void tst_SafetyGuard::aGapTripsAndSmallerOnesDoNot()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({1'000'000'000, 0, 0});
    guard.begin(tick(0, 900'000'000), Period, 0);  // the grid has moved, or the cycle is caught up
    guard.begin(tick(91, 9'000'000, 90), Period, 0);
    guard.begin(tick(191, 0, 100), Period, 0);
    QVERIFY(!guard.isTripped());
    guard.begin(tick(292, 1, 100), Period, 0);
    QVERIFY(guard.isTripped());
    const CycleEvent event = taken(reports).at(0);
    QCOMPARE(event.kind, CycleEvent::TrippedByGap);
    QCOMPARE(event.cycle, quint64(292));
    QCOMPARE(event.duration, qint64(1'000'000'001));
}

void tst_SafetyGuard::aSleepOfTheComputerIsAGap()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({1'000'000'000, 0, 0});
    constexpr qint64 slept = 3'600'000'000'000;  // before the phase: of no interest
    guard.begin(tick(0), Period, slept);
    guard.begin(tick(1), Period, slept);
    QVERIFY(!guard.isTripped());
    guard.begin(tick(2), Period, slept + 2'000'000'000);  // the clock of the cycles stood still
    QVERIFY(guard.isTripped());
}

void tst_SafetyGuard::overrunsInARowTripAndSingleOnesDoNot()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({0, 0, 3});
    quint64 cycle = 0;
    for (int round = 0; round < 10; ++round) {
        for (int i = 0; i < 3; ++i)
            guard.begin(tick(cycle += 2, 0, 1), Period, 0);
        guard.begin(tick(++cycle), Period, 0);
    }
    QVERIFY(!guard.isTripped());
    for (int i = 0; i < 4; ++i)
        guard.begin(tick(cycle += 2, 0, 1), Period, 0);
    QVERIFY(guard.isTripped());
    QCOMPARE(taken(reports).at(0).kind, CycleEvent::TrippedByOverruns);
}

void tst_SafetyGuard::aWaitTripsWhenItIsTooLong()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({0, 5'000'000'000, 0});
    NodeSlot slot;
    slot.id = 3;
    QVERIFY(!guard.waitedFor(slot, 9, 4'999'999'999));
    QVERIFY(!guard.isTripped());
    QVERIFY(guard.waitedFor(slot, 9, 5'000'000'000));
    QVERIFY(guard.isTripped());
    QCOMPARE(taken(reports).at(0).node, quint16(3));
}

void tst_SafetyGuard::withoutLimitsNothingTrips()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({});
    NodeSlot slot;
    for (quint64 cycle = 0; cycle < 100; ++cycle)
        guard.begin(tick(2 * cycle, 1'000'000'000'000, 1), Period, qint64(cycle) * 1'000'000'000'000);
    QVERIFY(!guard.waitedFor(slot, 9, 1'000'000'000'000));
    QVERIFY(!guard.isTripped());
    QVERIFY(taken(reports).isEmpty());
}

void tst_SafetyGuard::firstReasonIsReportedOnce()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({1, 1, 1});
    guard.request();  // of the thread of the master, who knows why
    QVERIFY(guard.isTripped());
    NodeSlot slot;
    slot.policy = QPlcSlaveNode::SafeStopWhenLate;
    guard.answeredLate(slot, 1);
    guard.begin(tick(5, 1'000), Period, 0);
    QVERIFY(taken(reports).isEmpty());
    guard.start({1, 1, 1});  // the next phase
    QVERIFY(!guard.isTripped());
    guard.answeredLate(slot, 1);
    guard.answeredLate(slot, 2);
    QCOMPARE(taken(reports).size(), 1);
}

/// A large plant in which everything goes wrong at once has more to tell than anybody has taken
/// meanwhile.
void tst_SafetyGuard::reasonIsReportedDespiteAFullQueue()
{
    CycleReports reports(false);
    SafetyGuard guard(reports);
    guard.start({1, 1, 1});
    for (int i = 0; i < 10'000; ++i)
        reports.post({CycleEvent::SignalSafe, 0, 0, 1});
    for (int i = 0; i < 10'000; ++i)
        reports.post({CycleEvent::WaitingForNode, 0, 0, 1});
    guard.begin(tick(5, 1'000), Period, 0);
    reports.post({CycleEvent::Ended, 0, 0, 6});
    const QVector<CycleEvent> events = taken(reports);
    QCOMPARE(events.at(events.size() - 2).kind, CycleEvent::TrippedByGap);
    QCOMPARE(events.last().kind, CycleEvent::Ended);
    const auto isWait = [](const CycleEvent &event) { return event.kind == CycleEvent::WaitingForNode; };
    QVERIFY(std::any_of(events.begin(), events.end(), isWait));
    QCOMPARE(reports.dropped() + quint64(events.size()), quint64(20'002));
}

QTEST_GUILESS_MAIN(tst_SafetyGuard)
#include "tst_SafetyGuard.moc"

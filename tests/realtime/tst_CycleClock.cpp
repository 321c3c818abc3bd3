// SPDX-License-Identifier: Apache-2.0
#include "realtime/CycleClock.h"

#include "FakeTime.h"

#include <QtTest/QtTest>

#include <random>

using qplc::CycleClock;

namespace {

constexpr std::int64_t Millisecond = 1'000'000;
constexpr std::int64_t Second = 1'000 * Millisecond;

const auto never = [] { return false; };

}  // namespace

class tst_CycleClock : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void firstCycleIsDueImmediately();
    void punctualCyclesFollowTheGrid();
    void lateWakeUpSkipsWholePeriods_data();
    void lateWakeUpSkipsWholePeriods();
    void seededDelaysAndInterruptionsAreCountedExactly_data();
    void seededDelaysAndInterruptionsAreCountedExactly();
    void gridDoesNotDriftInAYear();
    void interruptedSleepIsResumed();
    void stopEndsTheWaitAndConsumesNoCycle();
    void stopIsPolledAtLeastEvery50Milliseconds();
    void stopIsNotPolledWhenTheCycleIsDue();
    void periodZeroNeverLooksAtTheClock();
    void negativePeriodCountsAsZero();
    void shiftMovesTheGridAndNotTheNumber();
    void startBeginsANewGrid();
    void negativeClockTimeCausesNoLateness();
};

void tst_CycleClock::firstCycleIsDueImmediately()
{
    FakeTime time;
    time.time = 123'456'789;
    CycleClock clock(time, Millisecond);
    clock.start();
    const CycleClock::Tick tick = clock.next(never);
    QCOMPARE(tick.cycle, std::uint64_t(0));
    QCOMPARE(tick.skipped, std::uint64_t(0));
    QCOMPARE(tick.lateness, std::int64_t(0));
    QVERIFY(!tick.interrupted);
    QCOMPARE(time.sleeps, 0);
    QCOMPARE(clock.nominal(0), std::int64_t(123'456'789));
}

void tst_CycleClock::punctualCyclesFollowTheGrid()
{
    FakeTime time;
    CycleClock clock(time, 10 * Millisecond);
    clock.start();
    for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) {
        const CycleClock::Tick tick = clock.next(never);
        QCOMPARE(tick.cycle, cycle);
        QCOMPARE(tick.skipped, std::uint64_t(0));
        QCOMPARE(tick.lateness, std::int64_t(0));
        QCOMPARE(time.time, std::int64_t(cycle) * 10 * Millisecond);
        time.time += 3 * Millisecond;  // what the cycle computes
    }
}

void tst_CycleClock::lateWakeUpSkipsWholePeriods_data()
{
    QTest::addColumn<qint64>("late");  // [ns] behind the nominal time of cycle 1, period 1 ms
    QTest::addColumn<quint64>("cycle");
    QTest::addColumn<quint64>("skipped");
    QTest::addColumn<qint64>("lateness");

    QTest::newRow("in time") << qint64(0) << quint64(1) << quint64(0) << qint64(0);
    QTest::newRow("1 ns") << qint64(1) << quint64(1) << quint64(0) << qint64(1);
    QTest::newRow("1 ns before a period") << qint64(999'999) << quint64(1) << quint64(0) << qint64(999'999);
    QTest::newRow("one period") << qint64(1'000'000) << quint64(2) << quint64(1) << qint64(0);
    QTest::newRow("one period and 1 ns") << qint64(1'000'001) << quint64(2) << quint64(1) << qint64(1);
    QTest::newRow("many periods") << qint64(12'345'678) << quint64(13) << quint64(12) << qint64(345'678);
    QTest::newRow("suspended for a day") << qint64(86'400) * Second << quint64(86'400'001) << quint64(86'400'000)
                                         << qint64(0);
}

void tst_CycleClock::lateWakeUpSkipsWholePeriods()
{
    QFETCH(qint64, late);
    for (const bool asleep : {false, true}) {  // late by a long computation, or by a late wake-up
        FakeTime time;
        CycleClock clock(time, Millisecond);
        clock.start();
        clock.next(never);
        (asleep ? time.overshoot : time.time) += asleep ? late : Millisecond + late;
        const CycleClock::Tick tick = clock.next(never);
        QTEST(quint64(tick.cycle), "cycle");
        QTEST(quint64(tick.skipped), "skipped");
        QTEST(qint64(tick.lateness), "lateness");
        QCOMPARE(clock.nominal(tick.cycle) + tick.lateness, time.time);
    }
}

void tst_CycleClock::seededDelaysAndInterruptionsAreCountedExactly_data()
{
    QTest::addColumn<qint64>("period");
    QTest::newRow("1 ns") << qint64(1);
    QTest::newRow("100 us") << qint64(100'000);
    QTest::newRow("prime") << qint64(999'983);
    QTest::newRow("10 ms") << 10 * qint64(Millisecond);
    QTest::newRow("1 s") << qint64(Second);
}

void tst_CycleClock::seededDelaysAndInterruptionsAreCountedExactly()
{
    QFETCH(qint64, period);
    std::mt19937_64 random(quint64(period) + 7);
    const auto upTo = [&random](qint64 most) { return std::uniform_int_distribution<qint64>(0, most)(random); };

    FakeTime time;
    time.time = upTo(1000 * Second);
    const std::int64_t origin = time.time;
    CycleClock clock(time, period);
    clock.start();
    clock.next(never);

    std::uint64_t computed = 1;
    std::uint64_t skipped = 0;
    std::uint64_t last = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto injected = std::uint64_t(upTo(9) == 0 ? upTo(50) : 0);
        const std::int64_t lateness = upTo(period - 1);
        const std::int64_t due = origin + std::int64_t(last + 1) * period;
        const std::int64_t arrival = due + std::int64_t(injected) * period + lateness;
        if (upTo(1) == 0) {  // the computation takes until then, or the sleep ends then
            time.time = arrival;
        } else {
            time.time = std::max<std::int64_t>(time.time, due - upTo(period));
            time.interruptions = int(upTo(4));
            time.target = due;
            time.overshoot = arrival - due;
            if (time.time == due)
                time.time = arrival;
        }
        const CycleClock::Tick tick = clock.next(never);
        time.overshoot = time.interruptions = 0;

        QCOMPARE(time.time, arrival);
        QCOMPARE(tick.skipped, injected);
        QCOMPARE(tick.lateness, lateness);
        QCOMPARE(tick.cycle, last + 1 + injected);
        QCOMPARE(clock.nominal(tick.cycle), origin + std::int64_t(tick.cycle) * period);
        QVERIFY(!tick.interrupted);
        ++computed;
        skipped += tick.skipped;
        last = tick.cycle;
        QCOMPARE(computed + skipped, last + 1);
    }
    QVERIFY(skipped > 0);
}

void tst_CycleClock::gridDoesNotDriftInAYear()
{
    FakeTime time;
    CycleClock clock(time, 333'333);  // no divisor of a second
    clock.start();
    clock.next(never);
    const std::int64_t year = Second * 86'400 * 365;
    time.time = year;
    const CycleClock::Tick tick = clock.next(never);
    QCOMPARE(tick.cycle, std::uint64_t(year / 333'333));
    QCOMPARE(clock.nominal(tick.cycle), year / 333'333 * 333'333);
    QCOMPARE(tick.lateness, year % 333'333);
}

void tst_CycleClock::interruptedSleepIsResumed()
{
    FakeTime time;
    CycleClock clock(time, 10 * Millisecond);
    clock.start();
    clock.next(never);
    time.interruptions = 5;
    const CycleClock::Tick tick = clock.next(never);
    QCOMPARE(tick.cycle, std::uint64_t(1));
    QCOMPARE(tick.lateness, std::int64_t(0));
    QCOMPARE(time.time, 10 * Millisecond);
    QCOMPARE(time.sleeps, 6);
}

void tst_CycleClock::stopEndsTheWaitAndConsumesNoCycle()
{
    FakeTime time;
    CycleClock clock(time, 10 * Millisecond);
    clock.start();
    clock.next(never);
    time.interruptions = 1;
    int asked = 0;
    const CycleClock::Tick stopped = clock.next([&asked] { return ++asked == 2; });
    QVERIFY(stopped.interrupted);
    QCOMPARE(stopped.cycle, std::uint64_t(1));
    QCOMPARE(stopped.skipped, std::uint64_t(0));
    QVERIFY(time.time < 10 * Millisecond);

    const CycleClock::Tick resumed = clock.next(never);
    QVERIFY(!resumed.interrupted);
    QCOMPARE(resumed.cycle, std::uint64_t(1));
    QCOMPARE(time.time, 10 * Millisecond);
}

void tst_CycleClock::stopIsPolledAtLeastEvery50Milliseconds()
{
    FakeTime time;
    CycleClock clock(time, 10 * Second);
    clock.start();
    clock.next(never);
    int asked = 0;
    clock.next([&asked] { return ++asked < 0; });
    QCOMPARE(asked, 200);
    QVERIFY(time.longestSleep <= 50 * Millisecond);
    QCOMPARE(time.time, 10 * Second);
}

void tst_CycleClock::stopIsNotPolledWhenTheCycleIsDue()
{
    FakeTime time;
    CycleClock clock(time, Millisecond);
    clock.start();
    time.time = Second;
    QVERIFY(!clock.next([] { return true; }).interrupted);
}

void tst_CycleClock::periodZeroNeverLooksAtTheClock()
{
    FakeTime time;
    time.time = Second;
    CycleClock clock(time, 0);
    clock.start();
    for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) {
        const CycleClock::Tick tick = clock.next([] { return true; });
        QCOMPARE(tick.cycle, cycle);
        QCOMPARE(tick.skipped, std::uint64_t(0));
        QCOMPARE(tick.lateness, std::int64_t(0));
        QVERIFY(!tick.interrupted);
    }
    QCOMPARE(time.looks, 0);
    QCOMPARE(time.sleeps, 0);
}

void tst_CycleClock::negativePeriodCountsAsZero()
{
    FakeTime time;
    CycleClock clock(time, -5);
    clock.start();
    QCOMPARE(clock.period(), std::int64_t(0));
    clock.next(never);
    QCOMPARE(clock.next(never).cycle, std::uint64_t(1));
}

void tst_CycleClock::shiftMovesTheGridAndNotTheNumber()
{
    FakeTime time;
    CycleClock clock(time, Millisecond);
    clock.start();
    clock.next(never);
    time.time += 7 * Second;  // a slave kept the master waiting
    clock.shift(7 * Second);
    const CycleClock::Tick tick = clock.next(never);
    QCOMPARE(tick.cycle, std::uint64_t(1));
    QCOMPARE(tick.skipped, std::uint64_t(0));
    QCOMPARE(time.time, 7 * Second + Millisecond);
    QCOMPARE(clock.nominal(1), 7 * Second + Millisecond);
}

void tst_CycleClock::startBeginsANewGrid()
{
    FakeTime time;
    CycleClock clock(time, Millisecond);
    clock.start();
    clock.next(never);
    clock.next(never);
    time.time = 5 * Second + 11;
    clock.start();
    const CycleClock::Tick tick = clock.next(never);
    QCOMPARE(tick.cycle, std::uint64_t(0));
    QCOMPARE(tick.skipped, std::uint64_t(0));
    QCOMPARE(clock.nominal(0), 5 * Second + 11);
}

void tst_CycleClock::negativeClockTimeCausesNoLateness()
{
    FakeTime time;
    time.time = -5 * Second;  // nothing in the arithmetic asks for a positive clock
    CycleClock clock(time, Millisecond);
    clock.start();
    QCOMPARE(clock.next(never).lateness, std::int64_t(0));
    QCOMPARE(clock.next(never).cycle, std::uint64_t(1));
    QCOMPARE(time.time, -5 * Second + Millisecond);
}

QTEST_APPLESS_MAIN(tst_CycleClock)
#include "tst_CycleClock.moc"

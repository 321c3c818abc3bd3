// SPDX-License-Identifier: Apache-2.0
#include "FakeTime.h"
#include "realtime/CycleClock.h"

#include <QtTest/QtTest>

#include <random>

using qplc::CycleClock;
using Tick = CycleClock::Tick;

Q_DECLARE_METATYPE(QVector<quint64>)

namespace {

constexpr std::int64_t Period = 1'000'000;
const auto never = [] { return false; };

/// A clock whose cycle 0 has run and whose time stands \a late behind the nominal time of cycle 1.
struct LateClock
{
    LateClock(QPlcOverrunPolicy policy, std::int64_t late)
        : clock(time, Period, policy)
    {
        clock.start();
        clock.next(never);
        time.time = Period + late;
    }
    Tick next() { return clock.next(never); }

    FakeTime time;
    CycleClock clock;
};

/// The definition of the policies in whole numbers, cycle by cycle, without the arithmetic of the
/// clock: a list of the cycles that are due is worked off.
class Reference
{
public:
    Reference(QPlcOverrunPolicy policy, std::int64_t origin)
        : m_policy(policy)
        , m_origin(origin)
    {
    }

    /// The tick that follows when the clock stands at \a now, which is not before the cycle that is
    /// due next.
    Tick tick(std::int64_t now)
    {
        Tick tick;
        tick.woken = now;
        std::uint64_t due = m_next;  // the newest cycle whose time has come
        while (nominal(due + 1) <= now)
            ++due;
        const bool late = due > m_next;
        tick.overrun = late && m_inARow == 0;
        tick.cycle = m_next;
        if (late && m_policy.kind() == QPlcOverrunPolicy::SkipToGrid)
            tick.cycle = due;
        if (late && m_policy.kind() == QPlcOverrunPolicy::CatchUp) {
            while (due - tick.cycle > std::uint64_t(m_policy.catchUpCycles() - m_inARow))
                ++tick.cycle;
            tick.caughtUp = tick.cycle < due;
        }
        m_inARow = tick.caughtUp ? m_inARow + 1 : 0;
        tick.skipped = tick.cycle - m_next;
        tick.lateness = now - nominal(tick.cycle);
        if (late && m_policy.kind() == QPlcOverrunPolicy::Shift) {
            tick.shift = tick.lateness;
            m_origin += tick.lateness;
        }
        m_next = tick.cycle + 1;
        return tick;
    }
    std::int64_t nominal(std::uint64_t cycle) const { return m_origin + std::int64_t(cycle) * Period; }
    std::uint64_t next() const { return m_next; }

private:
    QPlcOverrunPolicy m_policy;
    std::int64_t m_origin;
    std::uint64_t m_next = 0;
    int m_inARow = 0;
};

}  // namespace

class tst_OverrunPolicies : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyPolicyRunsACycleThatIsLateByLessThanAPeriod_data() { everyPolicy(); }
    void everyPolicyRunsACycleThatIsLateByLessThanAPeriod();
    void skipToGridSkipsMissedCycles();
    void catchUpRunsTheNewestMissedCyclesInARow_data();
    void catchUpRunsTheNewestMissedCyclesInARow();
    void catchUpGivesUpAfterItsLimitWhenEveryCycleIsTooLong();
    void caughtUpCycleHasAPeriodOfItsOwn();
    void shiftMovesTheGridByTheOverrun();
    void stopNamesTheCycleAndConsumesNone();
    void lockstepHasNoOverruns_data() { everyPolicy(); }
    void lockstepHasNoOverruns();
    void tenThousandInjectedDelaysAreFoundExactly_data() { everyPolicy(); }
    void tenThousandInjectedDelaysAreFoundExactly();
    void policiesReadAndWriteTheirTexts_data();
    void policiesReadAndWriteTheirTexts();
    void invalidTextsAreRefused_data();
    void invalidTextsAreRefused();

private:
    static void everyPolicy();
};

void tst_OverrunPolicies::everyPolicy()
{
    QTest::addColumn<QPlcOverrunPolicy>("policy");
    for (const QPlcOverrunPolicy policy :
         {QPlcOverrunPolicy::skipToGrid(), QPlcOverrunPolicy::catchUp(1), QPlcOverrunPolicy::catchUp(4),
          QPlcOverrunPolicy::catchUp(1000), QPlcOverrunPolicy::shift(), QPlcOverrunPolicy::stop()})
        QTest::newRow(qPrintable(policy.toString())) << policy;
}

void tst_OverrunPolicies::everyPolicyRunsACycleThatIsLateByLessThanAPeriod()
{
    QFETCH(QPlcOverrunPolicy, policy);
    LateClock late(policy, Period - 1);
    const Tick tick = late.next();
    QCOMPARE(tick.cycle, std::uint64_t(1));
    QCOMPARE(tick.lateness, Period - 1);
    QCOMPARE(tick.woken, 2 * Period - 1);
    QCOMPARE(tick.deadline, 2 * Period);
    QVERIFY(!tick.overrun && !tick.caughtUp && !tick.stopped);
    QCOMPARE(tick.shift, std::int64_t(0));
    QCOMPARE(late.clock.nominal(5), 5 * Period);
}

void tst_OverrunPolicies::skipToGridSkipsMissedCycles()
{
    LateClock late(QPlcOverrunPolicy::skipToGrid(), 3 * Period + 7);
    const Tick tick = late.next();
    QCOMPARE(tick.cycle, std::uint64_t(4));
    QCOMPARE(tick.skipped, std::uint64_t(3));
    QCOMPARE(tick.lateness, std::int64_t(7));
    QCOMPARE(tick.deadline, 5 * Period);
    QVERIFY(tick.overrun);
    QVERIFY(!late.next().overrun);
}

void tst_OverrunPolicies::catchUpRunsTheNewestMissedCyclesInARow_data()
{
    QTest::addColumn<int>("limit");
    QTest::addColumn<qint64>("late");
    QTest::addColumn<QVector<quint64>>("cycles");
    QTest::addColumn<quint64>("skipped");
    QTest::newRow("one missed, one allowed") << 1 << qint64(Period) << QVector<quint64>{1, 2, 3} << quint64(0);
    QTest::newRow("three missed, three allowed")
        << 3 << qint64(3 * Period + 5) << QVector<quint64>{1, 2, 3, 4, 5} << quint64(0);
    QTest::newRow("three missed, many allowed")
        << 50 << qint64(3 * Period + 5) << QVector<quint64>{1, 2, 3, 4, 5} << quint64(0);
    QTest::newRow("four missed, three allowed")
        << 3 << qint64(4 * Period) << QVector<quint64>{2, 3, 4, 5, 6} << quint64(1);
    QTest::newRow("hundred missed, two allowed")
        << 2 << qint64(100 * Period + 1) << QVector<quint64>{99, 100, 101, 102} << quint64(98);
}

void tst_OverrunPolicies::catchUpRunsTheNewestMissedCyclesInARow()
{
    QFETCH(int, limit);
    QFETCH(qint64, late);
    QFETCH(QVector<quint64>, cycles);
    QFETCH(quint64, skipped);
    LateClock clock(QPlcOverrunPolicy::catchUp(limit), late);
    const std::int64_t begin = clock.time.time;
    const std::uint64_t current = std::uint64_t(begin / Period);
    quint64 overruns = 0;
    quint64 left = 0;
    for (const quint64 expected : cycles) {
        const Tick tick = clock.next();
        QCOMPARE(quint64(tick.cycle), expected);
        QCOMPARE(tick.caughtUp, expected < current);
        QCOMPARE(tick.lateness, clock.time.time - std::int64_t(expected) * Period);
        overruns += tick.overrun ? 1 : 0;
        left += tick.skipped;
        if (expected <= current)
            QCOMPARE(clock.time.time, begin);  // immediately
    }
    QCOMPARE(overruns, quint64(1));
    QCOMPARE(left, skipped);
    QCOMPARE(clock.clock.nominal(7), 7 * Period);  // the grid stands
}

void tst_OverrunPolicies::catchUpGivesUpAfterItsLimitWhenEveryCycleIsTooLong()
{
    LateClock clock(QPlcOverrunPolicy::catchUp(3), Period);
    int inARow = 0;
    int longest = 0;
    std::uint64_t computed = 1;
    std::uint64_t skipped = 0;
    std::uint64_t last = 0;
    for (int i = 0; i < 100; ++i) {
        const Tick tick = clock.next();
        inARow = tick.caughtUp ? inARow + 1 : 0;
        longest = std::max(longest, inARow);
        ++computed;
        skipped += tick.skipped;
        last = tick.cycle;
        clock.time.time += 2 * Period;
    }
    QCOMPARE(longest, 3);
    QCOMPARE(computed + skipped, last + 1);
    QVERIFY(skipped >= 90);  // twice too slow: nearly every second cycle is lost, whatever the policy
}

void tst_OverrunPolicies::caughtUpCycleHasAPeriodOfItsOwn()
{
    LateClock clock(QPlcOverrunPolicy::catchUp(2), 2 * Period + 10);
    QCOMPARE(clock.next().deadline, clock.time.time + Period);
    QCOMPARE(clock.next().deadline, clock.time.time + Period);
    QCOMPARE(clock.next().deadline, 4 * Period);  // on the grid again
}

void tst_OverrunPolicies::shiftMovesTheGridByTheOverrun()
{
    LateClock clock(QPlcOverrunPolicy::shift(), 2 * Period + 300);
    const Tick tick = clock.next();
    QCOMPARE(tick.cycle, std::uint64_t(1));
    QCOMPARE(tick.skipped, std::uint64_t(0));
    QCOMPARE(tick.lateness, 2 * Period + 300);  // from the time that it should have had
    QCOMPARE(tick.shift, 2 * Period + 300);
    QCOMPARE(tick.deadline, clock.time.time + Period);
    QVERIFY(tick.overrun);
    const Tick following = clock.next();
    QCOMPARE(following.cycle, std::uint64_t(2));
    QCOMPARE(following.lateness, std::int64_t(0));
    QVERIFY(!following.overrun);
    QCOMPARE(clock.time.time, 4 * Period + 300);
}

void tst_OverrunPolicies::stopNamesTheCycleAndConsumesNone()
{
    LateClock clock(QPlcOverrunPolicy::stop(), Period);
    for (int i = 0; i < 2; ++i) {
        const Tick tick = clock.next();
        QVERIFY(tick.stopped);
        QVERIFY(tick.overrun);
        QCOMPARE(tick.cycle, std::uint64_t(1));
        QCOMPARE(tick.lateness, std::int64_t(Period));
    }
}

void tst_OverrunPolicies::lockstepHasNoOverruns()
{
    QFETCH(QPlcOverrunPolicy, policy);
    FakeTime time;
    CycleClock clock(time, 0, policy);
    clock.start();
    for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
        time.time += 1'000'000'000;
        const Tick tick = clock.next(never);
        QCOMPARE(tick.cycle, cycle);
        QVERIFY(!tick.overrun && !tick.caughtUp && !tick.stopped);
    }
    QCOMPARE(time.looks, 0);
}

void tst_OverrunPolicies::tenThousandInjectedDelaysAreFoundExactly()
{
    QFETCH(QPlcOverrunPolicy, policy);
    std::mt19937_64 random(20260731);
    const auto upTo
        = [&random](std::int64_t most) { return std::uniform_int_distribution<std::int64_t>(0, most)(random); };
    FakeTime time;
    time.time = 123'456'789'012;
    CycleClock clock(time, Period, policy);
    Reference reference(policy, time.time);
    clock.start();
    clock.next(never);
    reference.tick(time.time);

    int injected = 0;
    int found = 0;
    while (injected < 10'000) {
        const std::int64_t due = std::max(reference.nominal(reference.next()), time.time);
        const bool inject = upTo(2) == 0;
        const std::int64_t delay = inject ? Period + upTo(upTo(3) == 0 ? 40 * Period : 3 * Period) : upTo(Period / 3);
        if (upTo(1) == 0 || due == time.time) {
            time.time = due + delay;  // the cycle before takes so long
        } else {
            time.target = due;  // the wake-up is so late, after interruptions
            time.overshoot = delay;
            time.interruptions = int(upTo(3));
        }
        const Tick tick = clock.next(never);
        if (tick.stopped) {
            QVERIFY(inject);
            QCOMPARE(tick.cycle, reference.next());
            QCOMPARE(tick.lateness, time.time - reference.nominal(reference.next()));
            ++injected;
            ++found;
            clock.start();  // a new phase
            clock.next(never);
            reference = Reference(policy, time.time);
            reference.tick(time.time);
            continue;
        }
        const Tick expected = reference.tick(time.time);
        QCOMPARE(tick.cycle, expected.cycle);
        QCOMPARE(tick.skipped, expected.skipped);
        QCOMPARE(tick.lateness, expected.lateness);
        QCOMPARE(tick.shift, expected.shift);
        QCOMPARE(tick.overrun, expected.overrun);
        QCOMPARE(tick.caughtUp, expected.caughtUp);
        QCOMPARE(tick.woken, time.time);
        const bool late = tick.overrun || tick.caughtUp || tick.skipped > 0;
        injected += inject ? 1 : 0;
        found += inject && late ? 1 : 0;
        // Nothing is found that was not injected; a backlog is worked off without a new overrun.
        QVERIFY(inject || !tick.overrun);
    }
    QCOMPARE(found, injected);
}

void tst_OverrunPolicies::policiesReadAndWriteTheirTexts_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QPlcOverrunPolicy>("policy");
    QTest::newRow("skip") << "skip" << QPlcOverrunPolicy();
    QTest::newRow("catch up") << "catch-up:3" << QPlcOverrunPolicy::catchUp(3);
    QTest::newRow("most") << "catch-up:1000000" << QPlcOverrunPolicy::catchUp(QPlcOverrunPolicy::MaximumCatchUp);
    QTest::newRow("shift") << "shift" << QPlcOverrunPolicy::shift();
    QTest::newRow("stop") << "stop" << QPlcOverrunPolicy::stop();
}

void tst_OverrunPolicies::policiesReadAndWriteTheirTexts()
{
    QFETCH(QString, text);
    QFETCH(QPlcOverrunPolicy, policy);
    QString error = QStringLiteral("old");
    QCOMPARE(QPlcOverrunPolicy::fromString(text, &error), policy);
    QCOMPARE(error, QString());
    QCOMPARE(policy.toString(), text);
    QVERIFY(policy.isValid());
}

void tst_OverrunPolicies::invalidTextsAreRefused_data()
{
    QTest::addColumn<QString>("text");
    for (const char *text : {"", "Skip", "catch-up", "catch-up:", "catch-up:0", "catch-up:-1", "catch-up:1000001",
                             "catch-up:3 ", "catch-up:99999999999", "shift ", "halt"})
        QTest::newRow(text) << QString::fromLatin1(text);
}

void tst_OverrunPolicies::invalidTextsAreRefused()
{
    QFETCH(QString, text);
    QString error;
    QCOMPARE(QPlcOverrunPolicy::fromString(text, &error), QPlcOverrunPolicy::skipToGrid());
    QVERIFY2(error.contains(QStringLiteral("'%1'").arg(text)) && error.contains("use "), qPrintable(error));
    QPlcOverrunPolicy::fromString(text);  // nobody wants to know
    QVERIFY(!QPlcOverrunPolicy::catchUp(0).isValid());
    QVERIFY(!QPlcOverrunPolicy::catchUp(QPlcOverrunPolicy::MaximumCatchUp + 1).isValid());
}

QTEST_APPLESS_MAIN(tst_OverrunPolicies)
#include "tst_OverrunPolicies.moc"

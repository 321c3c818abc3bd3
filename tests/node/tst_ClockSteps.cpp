// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "realtime/TimeSource.h"

#include <QtTest/QtTest>

#include <atomic>
#include <sys/syscall.h>
#include <unistd.h>

using namespace std::chrono_literals;

namespace {

std::atomic<std::int64_t> wallClockOffset{0};  // [s]

}  // namespace

// Comes before that of the C library for this program and the libraries that it uses: the wall clock is the test's to set.
extern "C" int clock_gettime(clockid_t clock, timespec *time)
{
    const long result = ::syscall(SYS_clock_gettime, clock, time);
    if (clock == CLOCK_REALTIME)
        time->tv_sec += wallClockOffset;
    return int(result);
}

// Somebody sets the wall clock while cycles run.
class tst_ClockSteps : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void cleanup() { wallClockOffset = 0; }
    void theWallClockIsThatOfTheTest();
    void aStepOfTheWallClockMovesNoCycle_data();
    void aStepOfTheWallClockMovesNoCycle();
};

void tst_ClockSteps::theWallClockIsThatOfTheTest()
{
    const std::int64_t before = qplc::wallClockNow();
    wallClockOffset = 3600;
    const std::int64_t passed = qplc::wallClockNow() - before;
    QVERIFY(passed > 3'500'000'000'000 && passed < 3'700'000'000'000);  // else these tests show nothing
}

void tst_ClockSteps::aStepOfTheWallClockMovesNoCycle_data()
{
    QTest::addColumn<int>("step");
    QTest::newRow("an hour ahead") << 3600;
    QTest::newRow("an hour back") << -3600;
    QTest::newRow("a leap second") << -1;
    QTest::newRow("years back") << -50 * 365 * 86400;
}

void tst_ClockSteps::aStepOfTheWallClockMovesNoCycle()
{
    QFETCH(int, step);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(5ms);
    master.setTimeSignal("time");
    EchoNode echo;
    CounterNode counter;
    std::atomic<int> gaps{0};
    counter.onStep = [&](const QPlcCycle &cycle) { gaps = gaps + (cycle.dt() != 0.005 ? 1 : 0); };
    counter.activateWatchdog(2s);
    QSignalSpy barked(&counter, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.addLocalNode(&echo) && master.listen() && master.admit(counter, "udp"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    const QPlcMasterStatistics before = master.statistics();
    const qint64 timeBefore = master.signalValue("time").toInt64();
    const quint64 cycleBefore = master.cycle();
    QElapsedTimer elapsed;
    elapsed.start();
    wallClockOffset = step;
    QVERIFY(master.waitForCycles(before.cycles + 60));
    const double passed = double(elapsed.nsecsElapsed()) * 1e-9;
    const qint64 time = master.signalValue("time").toInt64();
    const quint64 cycle = master.cycle();
    master.stop();
    // The time of the plant goes on with its cycles, and these with a clock that nobody can set.
    QVERIFY(time > timeBefore);
    QVERIFY(std::abs(double(time - timeBefore) * 1e-9 - double(cycle - cycleBefore) * 0.005) < 0.1);
    QVERIFY2(double(cycle - cycleBefore) * 0.005 < passed + 0.5, "cycles came faster than time");
    QCOMPARE(barked.size(), 0);
    QCOMPARE(int(gaps), 0);
}

QTEST_GUILESS_MAIN(tst_ClockSteps)
#include "tst_ClockSteps.moc"

// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "realtime/TimeSource.h"

#include <QtCore/QScopeGuard>
#include <QtTest/QtTest>

#include <atomic>
#include <sys/syscall.h>
#include <unistd.h>

using namespace std::chrono_literals;

namespace {

std::atomic<std::int64_t> wallClockOffset{0};  // [s]

}  // namespace

// Comes before that of the C library for this program and the libraries that it uses: the wall
// clock is the test's to set.
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
    void testControlsTheWallClock();
    void aStepOfTheWallClockMovesNoCycle_data();
    void aStepOfTheWallClockMovesNoCycle();
};

void tst_ClockSteps::testControlsTheWallClock()
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
    const auto end = qScopeGuard([&] {
        master.stop();
        counter.disconnectFromMaster();
    });
    QSignalSpy barked(&counter, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.addLocalNode(&echo) && master.listen() && master.admit(counter, "udp"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    QElapsedTimer elapsed;
    elapsed.start();
    const quint64 cyclesBefore = master.statistics().cycles;
    const qint64 timeBefore = master.signalValue("time").toInt64();
    wallClockOffset = step;
    QVERIFY(master.waitForCycles(cyclesBefore + 60));
    master.stop();
    const qint64 passed = master.signalValue("time").toInt64() - timeBefore;
    // The time of the plant goes on with its cycles, and these with a clock that nobody can set.
    QCOMPARE(passed % 5'000'000, qint64(0));
    QVERIFY2(passed >= 55 * 5'000'000, qPrintable(QString::number(passed)));
    QVERIFY2(passed <= elapsed.nsecsElapsed() + 30'000'000'000, qPrintable(QString::number(passed)));
    QCOMPARE(barked.size(), 0);
    QCOMPARE(int(gaps), 0);
}

QTEST_GUILESS_MAIN(tst_ClockSteps)
#include "tst_ClockSteps.moc"

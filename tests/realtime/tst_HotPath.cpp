// SPDX-License-Identifier: Apache-2.0
#include "FakeTime.h"
#include "ThreadCosts.h"
#include "realtime/CycleClock.h"
#include "realtime/CycleThread.h"
#include "realtime/Histogram.h"
#include "realtime/SnapshotBuffer.h"
#include "realtime/SpscRing.h"
#include "realtime/WakeUp.h"

#include <QtTest/QtTest>

#include <sys/mman.h>

namespace {

struct Event
{
    std::uint64_t cycle;
    char payload[56];
};

/// What a cycle does in this room, with time from a fake clock.
class Engine
{
public:
    void run(std::uint64_t cycles)
    {
        for (std::uint64_t i = 0; i < cycles; ++i) {
            const qplc::CycleClock::Tick tick = m_clock.next([] { return false; });
            m_lateness.record(tick.lateness);
            skipped += tick.skipped;
            ++computed;
            last = tick.cycle;
            m_image[tick.cycle % sizeof m_image] = char(tick.cycle);
            m_images.publish(m_image, tick.cycle);
            refused += !m_events.push({tick.cycle, {}});
            m_wakeUp.arm();  // as a reader would that sleeps each time
            m_wakeUp.notify();
            m_time.time += i % 10 == 0 ? 2'500'000 : 300'000;
        }
    }
    void start() { m_clock.start(); }

    std::uint64_t computed = 0;
    std::uint64_t skipped = 0;
    std::uint64_t refused = 0;
    std::uint64_t last = 0;

private:
    FakeTime m_time;
    qplc::CycleClock m_clock{m_time, 1'000'000};
    qplc::Histogram m_lateness;
    qplc::SnapshotBuffer m_images{1024};
    qplc::SpscRing<Event> m_events{4096};
    qplc::WakeUp m_wakeUp;
    char m_image[1024] = {};
};

}  // namespace

class tst_HotPath : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cyclesCauseNoAllocationNoLockAndNoPageFault_data();
    void cyclesCauseNoAllocationNoLockAndNoPageFault();
};

void tst_HotPath::cyclesCauseNoAllocationNoLockAndNoPageFault_data()
{
    QTest::addColumn<bool>("lockMemory");
    QTest::newRow("memory not locked: all was touched before") << false;
    QTest::newRow("memory locked") << true;  // the last one: what it leaves to the heap stays in memory
}

void tst_HotPath::cyclesCauseNoAllocationNoLockAndNoPageFault()
{
    QFETCH(bool, lockMemory);
    const auto engine = std::make_unique<Engine>();
    ThreadCosts spent;
    ThreadCosts inAll;
    qplc::CycleThread thread;
    QPlcRealTimeOptions options;
    options.lockMemory = lockMemory;
    const bool started = thread.start(QStringLiteral("hot path"), options, [&] {
        engine->start();
        engine->run(10);  // code pages, lazy binding
        const ThreadCosts before = ThreadCosts::ofThisThread();
        engine->run(1000);
        spent = ThreadCosts::ofThisThread() - before;
        std::free(std::malloc(3));
        inAll = ThreadCosts::ofThisThread();
    });
    QVERIFY2(started, qPrintable(thread.errorString()));
    thread.join();
    munlockall();

    QCOMPARE(engine->computed, std::uint64_t(1010));
    QCOMPARE(engine->computed + engine->skipped, engine->last + 1);
    QVERIFY(engine->skipped > 0);
    QCOMPARE(engine->refused, std::uint64_t(0));
    if (!ThreadCosts::areCounted())
        QSKIP("costs are not judged: the sanitizer has its own allocator and touches its own memory", "");
    QVERIFY(inAll.allocations > 0);  // the counter counts
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
    QCOMPARE(spent.pageFaults, std::uint64_t(0));
}

QTEST_APPLESS_MAIN(tst_HotPath)
#include "tst_HotPath.moc"

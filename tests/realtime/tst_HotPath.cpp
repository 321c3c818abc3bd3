// SPDX-License-Identifier: Apache-2.0
#include "FakeTime.h"
#include "realtime/CycleClock.h"
#include "realtime/CycleThread.h"
#include "realtime/Histogram.h"
#include "realtime/SnapshotBuffer.h"
#include "realtime/SpscRing.h"
#include "realtime/WakeUp.h"

#include <QtTest/QtTest>

#include <cstdlib>
#include <sys/mman.h>
#include <sys/resource.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define QTPLC_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QTPLC_SANITIZED
#endif

namespace {

thread_local long allocations = 0;

}  // namespace

#if !defined(QTPLC_SANITIZED)
// These stand before glibc's and call them by the names that glibc gives them; operator new and Qt come here, too.
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-inconsistent-*)
extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *memory, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

void *malloc(std::size_t size)
{
    ++allocations;
    return __libc_malloc(size);
}

void *calloc(std::size_t count, std::size_t size)
{
    ++allocations;
    return __libc_calloc(count, size);
}

void *realloc(void *memory, std::size_t size)
{
    ++allocations;
    return __libc_realloc(memory, size);
}

void *aligned_alloc(std::size_t alignment, std::size_t size)
{
    ++allocations;
    return __libc_memalign(alignment, size);
}
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-inconsistent-*)
#endif

namespace {

struct Event
{
    std::uint64_t cycle;
    char payload[56];
};

long minorFaults()
{
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt;
}

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
    void thousandCyclesAllocateNothingAndMeetNoNewPage_data();
    void thousandCyclesAllocateNothingAndMeetNoNewPage();
};

void tst_HotPath::thousandCyclesAllocateNothingAndMeetNoNewPage_data()
{
    QTest::addColumn<bool>("lockMemory");
    QTest::newRow("memory locked") << true;
    QTest::newRow("memory not locked: all was touched before") << false;
}

void tst_HotPath::thousandCyclesAllocateNothingAndMeetNoNewPage()
{
    QFETCH(bool, lockMemory);
    const auto engine = std::make_unique<Engine>();
    long allocated = -1;
    long faults = -1;
    qplc::CycleThread thread;
    QPlcRealTimeOptions options;
    options.lockMemory = lockMemory;
    const bool started = thread.start(QStringLiteral("hot path"), options, [&] {
        engine->start();
        engine->run(10);  // code pages, lazy binding
        const long allocationsBefore = allocations;
        const long faultsBefore = minorFaults();
        engine->run(1000);
        faults = minorFaults() - faultsBefore;
        allocated = allocations - allocationsBefore;
    });
    QVERIFY2(started, qPrintable(thread.errorString()));
    thread.join();
    munlockall();

    QCOMPARE(engine->computed, std::uint64_t(1010));
    QCOMPARE(engine->computed + engine->skipped, engine->last + 1);
    QVERIFY(engine->skipped > 0);
    QCOMPARE(engine->refused, std::uint64_t(0));
#if defined(QTPLC_SANITIZED)
    QSKIP("allocations and page faults are not judged: the sanitizer has its own allocator and touches its own memory",
          "");
#endif
    QVERIFY(allocations > 0);  // the counter works
    QCOMPARE(allocated, 0L);
    QCOMPARE(faults, 0L);
}

QTEST_APPLESS_MAIN(tst_HotPath)
#include "tst_HotPath.moc"

// SPDX-License-Identifier: Apache-2.0
#include "realtime/SpscRing.h"
#include "realtime/WakeUp.h"

#include <QtCore/QDeadlineTimer>
#include <QtTest/QtTest>

#include <limits>
#include <poll.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

using qplc::SpscRing;
using qplc::WakeUp;

namespace {

/// Two threads that hand over to each other need a time slice for each step when others want their
/// processors: they take so many steps as this time allows.
constexpr std::chrono::seconds LongEnough{10};

/// \param timeout  [ms]
bool isReadable(const WakeUp &wakeUp, int timeout = 0)
{
    pollfd descriptor{wakeUp.descriptor(), POLLIN, 0};
    return poll(&descriptor, 1, timeout) == 1;
}

/// Spins until \a counter has reached \a value; lets others run when that takes long.
void waitFor(const std::atomic<int> &counter, int value)
{
    for (int spins = 0; counter.load() < value; ++spins) {
        if (spins % 1000 == 999)
            std::this_thread::yield();
    }
}

}  // namespace

class tst_WakeUp : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void notifyIsSilentUntilTheReaderArms();
    void oneArmingGivesOneWakeUp();
    void consumeClearsTheWakeUp();
    void readerMayArmAgainBeforeItConsumes();
    void lackOfDescriptorsIsReported();
    void concurrentValueIsSeenOrWakesTheReader();
    void noWakeUpIsLost_data();
    void noWakeUpIsLost();
};

void tst_WakeUp::notifyIsSilentUntilTheReaderArms()
{
    WakeUp wakeUp;
    QVERIFY2(wakeUp.isValid(), qPrintable(wakeUp.errorString()));
    QVERIFY(wakeUp.errorString().isEmpty());
    for (int i = 0; i < 3; ++i)
        wakeUp.notify();
    QVERIFY(!isReadable(wakeUp));
    QVERIFY(!wakeUp.consume());
    wakeUp.arm();
    QVERIFY(!isReadable(wakeUp));
    wakeUp.notify();
    QVERIFY(isReadable(wakeUp));
}

void tst_WakeUp::oneArmingGivesOneWakeUp()
{
    WakeUp wakeUp;
    wakeUp.arm();
    wakeUp.notify();
    QVERIFY(wakeUp.consume());
    for (int i = 0; i < 1000; ++i)
        wakeUp.notify();
    QVERIFY(!isReadable(wakeUp));
}

void tst_WakeUp::consumeClearsTheWakeUp()
{
    WakeUp wakeUp;
    wakeUp.arm();
    wakeUp.notify();
    QVERIFY(wakeUp.consume());
    QVERIFY(!isReadable(wakeUp));
    QVERIFY(!wakeUp.consume());
}

void tst_WakeUp::readerMayArmAgainBeforeItConsumes()
{
    WakeUp wakeUp;
    wakeUp.arm();
    wakeUp.notify();
    wakeUp.arm();
    wakeUp.notify();  // two wake-ups wait: one consume() takes both
    QVERIFY(wakeUp.consume());
    QVERIFY(!wakeUp.consume());
}

void tst_WakeUp::lackOfDescriptorsIsReported()
{
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    const rlimit none{0, before.rlim_max};
    setrlimit(RLIMIT_NOFILE, &none);
    WakeUp wakeUp;
    setrlimit(RLIMIT_NOFILE, &before);
    QVERIFY(!wakeUp.isValid());
    QCOMPARE(wakeUp.descriptor(), -1);
    QVERIFY2(wakeUp.errorString().contains(QLatin1String("ulimit -n")), qPrintable(wakeUp.errorString()));
    wakeUp.arm();
    wakeUp.notify();  // harmless
    QVERIFY(!wakeUp.consume());
}

// Each round both sides do their two steps at the same instant: the case in which a plain store or
// load would be overtaken and the value be left lying without a wake-up.
void tst_WakeUp::concurrentValueIsSeenOrWakesTheReader()
{
    constexpr int end = std::numeric_limits<int>::max();
    SpscRing<int> ring(4);
    WakeUp wakeUp;
    std::atomic<int> begun{0};
    std::atomic<int> done{0};
    std::thread producer([&] {
        for (int round = 1;; ++round) {
            waitFor(begun, round);
            if (begun.load() == end)
                return;
            ring.push(round);
            wakeUp.notify();
            done.store(round);
        }
    });
    int lost = 0;
    int taken = 0;
    int rounds = 0;
    const QDeadlineTimer timer(LongEnough);
    while (rounds < 100'000 && !timer.hasExpired()) {
        const int round = ++rounds;
        begun.store(round);
        for (int delay = round % 1024; delay > 0; --delay)
            std::atomic_signal_fence(std::memory_order_seq_cst);  // the sides meet at each possible step
        wakeUp.arm();
        const bool found = ring.front() != nullptr;
        waitFor(done, round);
        lost += !found && !isReadable(wakeUp);
        int value = 0;
        taken += ring.pop(&value);
        wakeUp.notify();  // disarms
        wakeUp.consume();
    }
    begun.store(end);
    producer.join();
    QCOMPARE(lost, 0);
    QCOMPARE(taken, rounds);
}

void tst_WakeUp::noWakeUpIsLost_data()
{
    QTest::addColumn<int>("burst");  // values between two pauses of the producer
    QTest::newRow("single values") << 1;
    QTest::newRow("small bursts") << 3;
    QTest::newRow("without a pause") << 1'000'000;
}

void tst_WakeUp::noWakeUpIsLost()
{
    QFETCH(int, burst);
    constexpr int count = 50'000;
    SpscRing<int> ring(64);
    WakeUp wakeUp;
    std::thread producer([&] {
        const QDeadlineTimer timer(LongEnough);
        for (int number = 0; number < count; ++number) {
            while (!ring.push(number))
                std::this_thread::yield();
            wakeUp.notify();
            if (number % burst == burst - 1 && !timer.hasExpired())
                std::this_thread::yield();  // lets the reader fall asleep
        }
    });
    int next = 0;
    int wrong = 0;
    bool lost = false;
    while (next < count && !lost) {
        do {
            for (int number = 0; ring.pop(&number); ++next)
                wrong += number != next;
            wakeUp.arm();
        } while (ring.front());
        if (next < count) {
            lost = !isReadable(wakeUp, 30'000);  // the producer has more to say, so it must wake this thread up
            wakeUp.consume();
        }
    }
    while (lost && next < count) {  // lets the producer end
        int number = 0;
        next += ring.pop(&number);
    }
    producer.join();
    QVERIFY(!lost);
    QCOMPARE(wrong, 0);
    QCOMPARE(next, count);
}

QTEST_APPLESS_MAIN(tst_WakeUp)
#include "tst_WakeUp.moc"

// SPDX-License-Identifier: Apache-2.0
#include "realtime/InterruptibleWaits.h"
#include "realtime/TimeSource.h"

#include <QtCore/QElapsedTimer>
#include <QtTest/QtTest>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <thread>
#include <unistd.h>

using qplc::InterruptibleWaits;
using qplc::TimeSource;

class tst_InterruptibleWaits : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aWaitEndsEachPeriod();
    void waitIsInterruptedAtTheInstantAndRepeatedly();
    void onlyTheRequestingThreadIsInterrupted();
    void destructorEndsTheInterruptions();
    void anotherThreadEndsAWait();
    void usableSignalHandlerIsInstalled();

private:
    /// Waits for input that never comes. \return errno; 0 when the time was over before
    static int waitInVain(int milliseconds);
};

int tst_InterruptibleWaits::waitInVain(int milliseconds)
{
    const timespec time{milliseconds / 1000, (milliseconds % 1000) * 1'000'000L};
    return ::clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

void tst_InterruptibleWaits::aWaitEndsEachPeriod()
{
    const InterruptibleWaits interrupt(2'000'000);
    for (int i = 0; i < 5; ++i)
        QCOMPARE(waitInVain(20'000), EINTR);
}

void tst_InterruptibleWaits::waitIsInterruptedAtTheInstantAndRepeatedly()
{
    TimeSource &clock = TimeSource::monotonic();
    InterruptibleWaits interrupt;
    QCOMPARE(waitInVain(5), 0);  // none is set
    const std::int64_t instant = clock.now() + 10'000'000;
    interrupt.interruptAt(instant, 1'000'000);
    for (int i = 0; i < 3; ++i) {
        QCOMPARE(waitInVain(20'000), EINTR);
        QVERIFY(clock.now() >= instant);
    }
    interrupt.interruptAt(clock.now() + 3'600'000'000'000, 1'000'000);
    waitInVain(3);  // one that was under way
    QCOMPARE(waitInVain(20), 0);
    interrupt.interruptAt(clock.now() - 5, 1'000'000'000);  // over: at once
    // It comes before the wait, as it may: the next one ends it.
    interrupt.interruptAt(0, 1'000'000);
    QCOMPARE(waitInVain(20'000), EINTR);
}

void tst_InterruptibleWaits::onlyTheRequestingThreadIsInterrupted()
{
    const InterruptibleWaits interrupt(1'000'000'000);
    int other = -1;
    std::thread thread([&] {
        const InterruptibleWaits own(1'000'000);
        other = waitInVain(20'000);
    });
    QCOMPARE(waitInVain(20), 0);
    thread.join();
    QCOMPARE(other, EINTR);
}

void tst_InterruptibleWaits::destructorEndsTheInterruptions()
{
    {
        const InterruptibleWaits interrupt(1'000'000);
    }
    waitInVain(3);  // one that was under way
    QCOMPARE(waitInVain(20), 0);
}

void tst_InterruptibleWaits::anotherThreadEndsAWait()
{
    const InterruptibleWaits interruptible;
    std::atomic<bool> ended{false};
    std::thread other([&, waiting = ::pthread_self()] {
        while (!ended) {
            InterruptibleWaits::interrupt(waiting);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    const int result = waitInVain(60'000);
    ended = true;
    other.join();
    QCOMPARE(result, EINTR);
}

void tst_InterruptibleWaits::usableSignalHandlerIsInstalled()
{
    struct sigaction handler = {};
    ::sigaction(SIGURG, nullptr, &handler);
    QVERIFY(handler.sa_handler != SIG_DFL
            && handler.sa_handler != SIG_IGN);  // ours: an ignored signal interrupts nothing
    QVERIFY((handler.sa_flags & SA_RESTART) == 0);
}

QTEST_APPLESS_MAIN(tst_InterruptibleWaits)
#include "tst_InterruptibleWaits.moc"

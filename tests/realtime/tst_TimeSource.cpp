// SPDX-License-Identifier: Apache-2.0
#include "realtime/TimeSource.h"

#include <QtCore/QDateTime>
#include <QtTest/QtTest>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <pthread.h>
#include <thread>

using qplc::TimeSource;

class tst_TimeSource : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void monotonicTimeNeverGoesBack();
    void sleepEndsNotBeforeItsDeadline();
    void deadlineInThePastDoesNotSleep_data();
    void deadlineInThePastDoesNotSleep();
    void signalInterruptsTheSleepAndErrnoStays();
    void wallClockIsThatOfQt();
};

void tst_TimeSource::monotonicTimeNeverGoesBack()
{
    TimeSource &time = TimeSource::monotonic();
    std::int64_t before = time.now();
    for (int i = 0; i < 10000; ++i) {
        const std::int64_t now = time.now();
        QVERIFY(now >= before);
        before = now;
    }
    QCOMPARE(&TimeSource::monotonic(), &time);
}

void tst_TimeSource::sleepEndsNotBeforeItsDeadline()
{
    TimeSource &time = TimeSource::monotonic();
    for (int i = 0; i < 5; ++i) {
        const std::int64_t deadline = time.now() + 200'000;
        QVERIFY(time.sleepUntil(deadline));
        QVERIFY(time.now() >= deadline);
    }
}

void tst_TimeSource::deadlineInThePastDoesNotSleep_data()
{
    QTest::addColumn<qint64>("deadline");
    QTest::newRow("zero") << qint64(0);
    QTest::newRow("1 ns") << qint64(1);
    QTest::newRow("before the clock began") << qint64(-1);
    QTest::newRow("smallest") << std::numeric_limits<qint64>::min();
}

void tst_TimeSource::deadlineInThePastDoesNotSleep()
{
    QFETCH(qint64, deadline);
    QVERIFY(TimeSource::monotonic().sleepUntil(deadline));
}

void tst_TimeSource::signalInterruptsTheSleepAndErrnoStays()
{
    struct sigaction action
    {
    };
    action.sa_handler = [](int) {};
    sigaction(SIGUSR1, &action, nullptr);

    std::atomic<bool> awake{false};
    bool completed = true;
    int error = -1;
    std::thread sleeper([&] {
        TimeSource &time = TimeSource::monotonic();
        errno = 0;
        completed = time.sleepUntil(time.now() + 600'000'000'000);
        error = errno;
        awake = true;
    });
    while (!awake) {  // until the signal meets it asleep
        pthread_kill(sleeper.native_handle(), SIGUSR1);
        std::this_thread::yield();
    }
    sleeper.join();
    QVERIFY(!completed);
    QCOMPARE(error, 0);
}

void tst_TimeSource::wallClockIsThatOfQt()
{
    const qint64 before = QDateTime::currentMSecsSinceEpoch();
    const qint64 wall = qplc::wallClockNow() / 1'000'000;
    const qint64 after = QDateTime::currentMSecsSinceEpoch();
    QVERIFY(before <= wall && wall <= after);
}

QTEST_APPLESS_MAIN(tst_TimeSource)
#include "tst_TimeSource.moc"

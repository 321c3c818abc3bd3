// SPDX-License-Identifier: Apache-2.0
#include "realtime/AlarmTime.h"

#include <QtTest/QtTest>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

using qplc::AlarmTime;

namespace {

constexpr std::int64_t Period = 3'000'000;

bool isReadable(int descriptor, int milliseconds)
{
    pollfd polled{descriptor, POLLIN, 0};
    return ::poll(&polled, 1, milliseconds) == 1;
}

/// No further descriptors while it lives.
class NoDescriptors
{
public:
    NoDescriptors()
    {
        ::getrlimit(RLIMIT_NOFILE, &m_before);
        const rlimit none{0, m_before.rlim_max};
        ::setrlimit(RLIMIT_NOFILE, &none);
    }
    ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &m_before); }

private:
    rlimit m_before{};
};

}  // namespace

class tst_AlarmTime : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void sleepsEndOnTheGrid();
    void theAlarmRingsAtItsTimeAndNotBefore();
    void sleepAndWaitShareTheSameAlarm();
    void aGridThatMovesIsFollowed();
    void aMissedAlarmDoesNotEndTheNextSleep();
    void sleepWorksWithoutAPeriod();
    void sleepWorksWithoutATimer();
};

void tst_AlarmTime::sleepsEndOnTheGrid()
{
    AlarmTime time;
    time.setPeriod(Period);
    std::int64_t deadline = time.now();
    for (int i = 0; i < 5; ++i) {
        deadline += Period;
        QVERIFY(time.sleepUntil(deadline));
        QVERIFY(time.now() >= deadline);
    }
    QVERIFY(time.sleepUntil(-1));  // long ago
}

void tst_AlarmTime::theAlarmRingsAtItsTimeAndNotBefore()
{
    AlarmTime time;
    time.setPeriod(Period);
    const std::int64_t deadline = time.now() + 20 * Period;
    const int alarm = time.alarm(deadline);
    QVERIFY(alarm >= 0);
    const bool early = isReadable(alarm, 0);
    QVERIFY(!early || time.now() >= deadline);
    QVERIFY(isReadable(alarm, 60'000));
    QVERIFY(time.now() >= deadline);
    QVERIFY(isReadable(alarm, 0));  // it stays so
}

void tst_AlarmTime::sleepAndWaitShareTheSameAlarm()
{
    AlarmTime time;
    time.setPeriod(Period);
    std::int64_t deadline = time.now();
    for (int i = 0; i < 5; ++i) {
        deadline += Period;
        const int alarm = time.alarm(deadline);
        if (i % 2 == 0)
            QVERIFY(isReadable(alarm, 60'000));
        QVERIFY(time.sleepUntil(deadline));
        QVERIFY(time.now() >= deadline);
    }
}

void tst_AlarmTime::aGridThatMovesIsFollowed()
{
    AlarmTime time;
    time.setPeriod(Period);
    std::int64_t deadline = time.now();
    for (const std::int64_t shift : {std::int64_t(0), Period / 3, std::int64_t(0), -Period / 2, 7 * Period}) {
        deadline += Period + shift;
        QVERIFY(time.sleepUntil(deadline));
        QVERIFY(time.now() >= deadline);
    }
}

void tst_AlarmTime::aMissedAlarmDoesNotEndTheNextSleep()
{
    AlarmTime time;
    time.setPeriod(Period);
    const std::int64_t first = time.now() + Period;
    const int alarm = time.alarm(first);
    QVERIFY(isReadable(alarm, 60'000));
    QTest::qSleep(10);  // and several more are over
    const std::int64_t next = time.now() + Period;
    QVERIFY(time.sleepUntil(next));
    QVERIFY(time.now() >= next);
    QVERIFY(time.sleepUntil(next + Period));
    QVERIFY(time.now() >= next + Period);
}

void tst_AlarmTime::sleepWorksWithoutAPeriod()
{
    AlarmTime time;
    for (const std::int64_t pause : {Period, 2 * Period, Period}) {
        const std::int64_t deadline = time.now() + pause;
        QVERIFY(time.sleepUntil(deadline));
        QVERIFY(time.now() >= deadline);
    }
}

void tst_AlarmTime::sleepWorksWithoutATimer()
{
    const NoDescriptors exhausted;
    AlarmTime time;
    time.setPeriod(Period);
    const std::int64_t deadline = time.now() + Period;
    QCOMPARE(time.alarm(deadline), -1);
    QVERIFY(time.sleepUntil(deadline));
    QVERIFY(time.now() >= deadline);
}

QTEST_APPLESS_MAIN(tst_AlarmTime)
#include "tst_AlarmTime.moc"

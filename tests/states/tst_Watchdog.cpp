// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/Watchdog.h"

#include <QtTest/QtTest>

#include <vector>

using qplc::Watchdog;

// When the watchdog of a node barks, and how often it is looked at for that.
class tst_Watchdog : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void watchdogExpiresExactlyAfterTheLastFrame_data();
    void watchdogExpiresExactlyAfterTheLastFrame();
    void watchdogIsPolledOncePerTimeoutWhileFramesArrive();
    void watchdogExpiresOnceUntilTheNextFrame();
    void earlyPollKeepsTheDeadline();
    void watchdogWithoutTimeoutNeverExpires();
};

namespace {

struct Story
{
    int looks = 0;
    std::vector<std::int64_t> barks;
};

/// What an owner does that looks at each alarm, until \a end, while \a frames come.
Story live(std::int64_t time, const std::vector<std::int64_t> &frames, std::int64_t end)
{
    Watchdog dog;
    dog.start(time, 0);
    Story story;
    std::size_t next = 0;
    while (dog.alarm() <= end) {
        const std::int64_t alarm = dog.alarm();
        for (; next < frames.size() && frames[next] <= alarm; ++next)
            dog.hear(frames[next]);
        ++story.looks;
        if (dog.look(alarm) == Watchdog::Barks)
            story.barks.push_back(alarm);
    }
    return story;
}

std::vector<std::int64_t> every(std::int64_t period, std::int64_t until)
{
    std::vector<std::int64_t> frames;
    for (std::int64_t time = period; time <= until; time += period)
        frames.push_back(time);
    return frames;
}

}  // namespace

void tst_Watchdog::watchdogExpiresExactlyAfterTheLastFrame_data()
{
    QTest::addColumn<qint64>("last");
    for (qint64 last : {0, 1, 9'999, 10'000, 29'999, 30'000, 30'001, 1'000'007})
        QTest::addRow("%lld", last) << last;
}

void tst_Watchdog::watchdogExpiresExactlyAfterTheLastFrame()
{
    QFETCH(qint64, last);
    std::vector<std::int64_t> frames = every(10'000, last);
    frames.push_back(last);
    const Story story = live(30'000, frames, 2'000'000);
    QCOMPARE(story.barks.size(), std::size_t(1));
    QCOMPARE(story.barks[0], std::int64_t(last + 30'000));
}

void tst_Watchdog::watchdogIsPolledOncePerTimeoutWhileFramesArrive()
{
    const Story story = live(30'000, every(1'000, 3'000'000), 3'000'000);
    QVERIFY(story.barks.empty());
    QVERIFY2(story.looks <= 101, qPrintable(QString::number(story.looks)));
}

void tst_Watchdog::watchdogExpiresOnceUntilTheNextFrame()
{
    const Story story = live(30'000, {10'000, 200'000}, 1'000'000);
    QCOMPARE(story.barks, (std::vector<std::int64_t>{40'000, 230'000}));
}

void tst_Watchdog::earlyPollKeepsTheDeadline()
{
    Watchdog dog;
    dog.start(100, 0);
    QCOMPARE(dog.look(99), Watchdog::TooEarly);
    QCOMPARE(dog.alarm(), std::int64_t(100));
    dog.hear(60);
    QCOMPARE(dog.look(130), Watchdog::Calm);  // late itself
    QCOMPARE(dog.alarm(), std::int64_t(160));
    QCOMPARE(dog.look(160), Watchdog::Barks);
}

void tst_Watchdog::watchdogWithoutTimeoutNeverExpires()
{
    Watchdog dog;
    dog.start(0, 0);
    QVERIFY(!dog.isOn());
    QCOMPARE(dog.look(1'000'000'000), Watchdog::TooEarly);
}

QTEST_APPLESS_MAIN(tst_Watchdog)
#include "tst_Watchdog.moc"

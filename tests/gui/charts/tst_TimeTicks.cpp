// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/TimeTicks.h"

#include <QtCore/QDateTime>
#include <QtTest/QtTest>

using namespace qplc;
using Time = TimeTicks::Time;

namespace {

constexpr Time s = 1'000'000'000;

Time at(int hour, int minute, int second)
{
    return QDateTime(QDate(2026, 3, 14), QTime(hour, minute, second)).toSecsSinceEpoch() * s;
}

QStringList labels(const TimeTicks &ticks)
{
    QStringList texts;
    for (const Time time : ticks.major())
        texts << ticks.label(time);
    return texts;
}

}  // namespace

class tst_TimeTicks : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void ticksAreAtRoundTimesOfTheDay();
    void ticksMoveWithTheData();
    void tickCountStaysWithinTheAvailableRoom();
    void shortSpansHaveFractions();
    void longSpansHaveNoSeconds();
    void moreThanADayHasDates();
    void secondsAreCountedFromTheReference();
    void eventTicksShowUnits();
    void clockTextResolvesTheGivenStep();
};

void tst_TimeTicks::ticksAreAtRoundTimesOfTheDay()
{
    const TimeTicks ticks(at(12, 3, 4), at(12, 3, 34), 7);
    QCOMPARE(labels(ticks), (QStringList{"12:03:05", "12:03:10", "12:03:15", "12:03:20", "12:03:25", "12:03:30"}));
    for (const Time time : ticks.minor())
        QVERIFY(!ticks.major().contains(time));
}

void tst_TimeTicks::ticksMoveWithTheData()
{
    const TimeTicks before(at(12, 0, 0), at(12, 0, 30), 6);
    const TimeTicks after(at(12, 0, 1), at(12, 0, 31), 6);
    QVERIFY(after.major().contains(before.major().last()));
}

void tst_TimeTicks::tickCountStaysWithinTheAvailableRoom()
{
    for (const Time span : {Time(100'000), 7 * s / 1000, 3 * s, 100 * s, 3601 * s, 86400 * s, 30 * 86400 * s}) {
        for (const int widest : {1, 2, 5, 11}) {
            const TimeTicks ticks(at(1, 2, 3), at(1, 2, 3) + span, widest);
            QVERIFY2(ticks.major().size() <= widest + 1, qPrintable(QString::number(span)));
            QVERIFY(ticks.step() * widest >= span);
        }
    }
    QVERIFY(TimeTicks(5, 5, 0).major().size() <= 1);
}

void tst_TimeTicks::shortSpansHaveFractions()
{
    const TimeTicks ticks(at(12, 0, 0), at(12, 0, 1), 4);
    QCOMPARE(labels(ticks), (QStringList{"12:00:00.0", "12:00:00.5", "12:00:01.0"}));
    const TimeTicks finer(at(12, 0, 0), at(12, 0, 0) + s / 1000, 4);
    QCOMPARE(labels(finer).last(), QStringLiteral("12:00:00.0010"));
}

void tst_TimeTicks::longSpansHaveNoSeconds()
{
    const TimeTicks ticks(at(12, 0, 0), at(18, 0, 0), 6);
    QCOMPARE(labels(ticks).first(), QStringLiteral("12:00"));
    QCOMPARE(ticks.step(), 3600 * s);
}

void tst_TimeTicks::moreThanADayHasDates()
{
    const auto dateOf = [](Time time) {
        return QLocale::c().toString(QDateTime::fromMSecsSinceEpoch(time / 1'000'000).date(), QStringLiteral("d MMM"));
    };
    const Time day = at(0, 0, 0);
    const TimeTicks days(day, day + 10 * 86400 * s, 11);
    QCOMPARE(days.step(), 86400 * s);
    QCOMPARE(labels(days).first(), dateOf(day));
    QCOMPARE(labels(days).last(), dateOf(day + 10 * 86400 * s));
    QCOMPARE(labels(TimeTicks(day, day + 36 * 3600 * s, 3)),
             (QStringList{dateOf(day), "12:00", dateOf(day + 86400 * s), "12:00"}));
    QCOMPARE(labels(TimeTicks(day, day + 86400 * s, 2)), (QStringList{"00:00", "12:00", "00:00"}));
}

void tst_TimeTicks::secondsAreCountedFromTheReference()
{
    const Time edge = at(12, 0, 0) + 123'456'789;
    QCOMPARE(labels(TimeTicks(edge - 30 * s, edge, 3, edge)), (QStringList{"-30", "-20", "-10", "0"}));
    QCOMPARE(labels(TimeTicks(edge - s / 2, edge + s / 2, 2, edge)), (QStringList{"-0.5", "0.0", "0.5"}));
}

void tst_TimeTicks::eventTicksShowUnits()
{
    const Time event = at(12, 0, 0) + 123'456'789;
    QCOMPARE(labels(TimeTicks::aroundEvent(event - s / 5, event + 4 * s / 5, 5, event)),
             (QStringList{"-200 ms", "0", "200 ms", "400 ms", "600 ms", "800 ms"}));
    QCOMPARE(labels(TimeTicks::aroundEvent(event, event + s / 5'000, 2, event)),
             (QStringList{"0", "0.1 ms", "0.2 ms"}));
    QCOMPARE(labels(TimeTicks::aroundEvent(event - 10 * s, event + 20 * s, 3, event)),
             (QStringList{"-10 s", "0", "10 s", "20 s"}));
}

void tst_TimeTicks::clockTextResolvesTheGivenStep()
{
    QCOMPARE(TimeTicks::clockText(at(1, 2, 3) + 4'000'000, 1'000'000), QStringLiteral("01:02:03.004"));
    QCOMPARE(TimeTicks::clockText(at(1, 2, 3) + 4'000, 1'000), QStringLiteral("01:02:03.000004"));
    QCOMPARE(TimeTicks::clockText(at(1, 2, 3), 10 * s), QStringLiteral("01:02:03"));
    QCOMPARE(beginOfDay(at(23, 59, 59)), at(0, 0, 0));
    QCOMPARE(beginOfDay(at(0, 0, 0)), at(0, 0, 0));
}

QTEST_APPLESS_MAIN(tst_TimeTicks)
#include "tst_TimeTicks.moc"

// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/TimeColumns.h"

#include <QtTest/QtTest>

#include <cmath>

using qplc::TimeColumns;
using Time = TimeColumns::Time;

namespace {

constexpr Time second = 1'000'000'000;

}  // namespace

class tst_TimeColumns : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void eachTimeIsInTheColumnThatHasIt_data();
    void eachTimeIsInTheColumnThatHasIt();
    void bordersStayWhereTheyAreWhenTheViewMoves();
    void firstColumnIsAtMostHalfAColumnAwayFromTheView();
    void viewUpToTheNewestTimeEndsWithItsColumn();
    void viewOfWholeColumnsIsFoundAgain();
    void columnsCoverViewsOfAnyWidth();
    void emptyViewHasColumns();
};

void tst_TimeColumns::eachTimeIsInTheColumnThatHasIt_data()
{
    QTest::addColumn<qint64>("begin");
    QTest::addColumn<qint64>("span");
    QTest::addColumn<int>("count");
    QTest::newRow("ten seconds") << qint64(5 * second) << qint64(10 * second) << 640;
    QTest::newRow("before time 0") << qint64(-5 * second) << qint64(10 * second) << 643;
    QTest::newRow("since 1970") << qint64(1'800'000'000) * second << qint64(7 * second) << 999;
    QTest::newRow("a day") << qint64(0) << qint64(86400 * second) << 1;
    QTest::newRow("a microsecond") << qint64(1'800'000'000) * second << qint64(1000) << 640;
    QTest::newRow("a nanosecond") << qint64(77) << qint64(1) << 640;
}

void tst_TimeColumns::eachTimeIsInTheColumnThatHasIt()
{
    QFETCH(qint64, begin);
    QFETCH(qint64, span);
    QFETCH(int, count);
    const TimeColumns columns(begin, begin + span, count);
    QCOMPARE(columns.end() - columns.first(), std::int64_t(count));
    for (int i = -3; i < count + 3; ++i) {
        const std::int64_t column = columns.first() + i;
        const Time from = columns.beginOf(column);
        const Time to = columns.beginOf(column + 1);
        QVERIFY(from <= to);
        QVERIFY(columns.columnOf(from) >= column);
        QVERIFY(columns.columnOf(from - 1) < column);
        if (from < to)
            QCOMPARE(columns.columnOf(to - 1), column);
    }
}

void tst_TimeColumns::bordersStayWhereTheyAreWhenTheViewMoves()
{
    const TimeColumns columns(100 * second, 110 * second, 613);
    const Time border = columns.beginOf(columns.first() + 300);
    for (Time shift = 0; shift < second; shift += 1'234'567) {
        const TimeColumns moved(100 * second + shift, 110 * second + shift, 613);
        QCOMPARE(moved.width(), columns.width());
        QCOMPARE(moved.beginOf(moved.columnOf(border)), border);
    }
}

void tst_TimeColumns::firstColumnIsAtMostHalfAColumnAwayFromTheView()
{
    for (Time begin = -second; begin < second; begin += 1'234'567) {
        const TimeColumns columns(begin, begin + 10 * second, 613);
        QVERIFY(std::abs(double(columns.beginOf(columns.first()) - begin)) <= 0.5 * columns.width() + 1.0);
    }
}

void tst_TimeColumns::viewUpToTheNewestTimeEndsWithItsColumn()
{
    int changes = 0;
    TimeColumns last;
    for (Time newest = 0; newest < 2 * second; newest += 1'000'000) {
        const TimeColumns columns = TimeColumns::upTo(newest, 10 * second, 1000);
        QCOMPARE(columns.columnOf(newest), columns.end() - 1);
        QCOMPARE(columns.count(), 1000);
        changes += columns != last ? 1 : 0;
        last = columns;
    }
    QCOMPARE(changes, 200);  // 2 s in columns of 10 ms
}

void tst_TimeColumns::viewOfWholeColumnsIsFoundAgain()
{
    for (Time newest = 0; newest < 2 * second; newest += 1'234'567) {
        const TimeColumns columns = TimeColumns::upTo(newest, 10 * second, 613);
        QVERIFY(TimeColumns(columns.beginOf(columns.first()), columns.beginOf(columns.end()), 613) == columns);
    }
}

void tst_TimeColumns::columnsCoverViewsOfAnyWidth()
{
    for (Time span = 1000; span < 1'000'000 * second; span = span * 3 / 2) {
        const TimeColumns columns(5 * second, 5 * second + span, 1920);
        const double width = columns.width() * 1920;
        QVERIFY2(std::abs(width - double(span)) < 0.1 * columns.width(), qPrintable(QString::number(span)));
        const auto right = double(columns.columnOf(5 * second + span) - columns.first());
        QVERIFY2(std::abs(right - 1920) <= 1.0, qPrintable(QString::number(right)));
    }
}

void tst_TimeColumns::emptyViewHasColumns()
{
    const TimeColumns columns(second, second, 100);
    QCOMPARE(columns.count(), 100);
    QVERIFY(columns.width() > 0.0);
}

QTEST_APPLESS_MAIN(tst_TimeColumns)
#include "tst_TimeColumns.moc"

// SPDX-License-Identifier: Apache-2.0
#include "hardware/gpio/Debouncer.h"

#include <QtTest/QtTest>

using qplc::Debouncer;

class tst_Debouncer : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void firstLevelCausesNoEdge();
    void debouncerWithoutPeriodReportsEveryChange();
    void aLevelCountsWhenItHasStayedForThePeriod();
    void bouncesGiveOneEdgeAtTheStartOfTheLastLevel();
    void glitchCausesNoEdge();
    void twoQuickPressesAreBothSeen();
    void anOlderTimeCountsAsTheNewest();
    void firstLevelAfterResetIsAcceptedWithoutEdge();
};

void tst_Debouncer::firstLevelCausesNoEdge()
{
    Debouncer input(5);
    QVERIFY(!input.isKnown());
    QVERIFY(!input.feed(true, 1000));
    QVERIFY(input.isKnown());
    QVERIFY(input.isOn());
}

void tst_Debouncer::debouncerWithoutPeriodReportsEveryChange()
{
    Debouncer input;
    input.feed(false, 0);
    QVERIFY(input.feed(true, 10));
    QVERIFY(input.isOn());
    QCOMPARE(input.edgeTime(), qint64(10));
    QVERIFY(!input.feed(true, 20));
    QVERIFY(input.feed(false, 30));
    QCOMPARE(input.edgeTime(), qint64(30));
}

void tst_Debouncer::aLevelCountsWhenItHasStayedForThePeriod()
{
    Debouncer input(5);
    input.feed(false, 0);
    QVERIFY(!input.feed(true, 10));
    QVERIFY(!input.feed(true, 14));
    QVERIFY(!input.isOn());
    QVERIFY(input.feed(true, 15));
    QVERIFY(input.isOn());
    QCOMPARE(input.edgeTime(), qint64(10));
}

void tst_Debouncer::bouncesGiveOneEdgeAtTheStartOfTheLastLevel()
{
    Debouncer input(5);
    int edges = 0;
    input.feed(false, 0);
    for (const qint64 time : {10, 11, 12, 13, 14}) {
        edges += input.feed(time % 2 == 0, time) ? 1 : 0;
    }
    for (const qint64 time : {16, 18, 20, 22})
        edges += input.feed(true, time) ? 1 : 0;
    QCOMPARE(edges, 1);
    QVERIFY(input.isOn());
    QCOMPARE(input.edgeTime(), qint64(14));
}

void tst_Debouncer::glitchCausesNoEdge()
{
    Debouncer input(5);
    input.feed(true, 0);
    QVERIFY(!input.feed(false, 10));
    QVERIFY(!input.feed(true, 14));
    QVERIFY(!input.feed(true, 100));
    QVERIFY(input.isOn());
}

// Edges of a cycle come together, with their times: a press that is over was a press if it was long
// enough.
void tst_Debouncer::twoQuickPressesAreBothSeen()
{
    Debouncer input(5);
    int edges = 0;
    input.feed(false, 0);
    for (const auto &[isOn, time] : {std::pair{true, 10}, {false, 20}, {true, 30}, {false, 40}, {false, 100}})
        edges += input.feed(isOn, time) ? 1 : 0;
    QCOMPARE(edges, 4);
    QVERIFY(!input.isOn());
    QCOMPARE(input.edgeTime(), qint64(40));
}

void tst_Debouncer::anOlderTimeCountsAsTheNewest()
{
    Debouncer input(5);
    input.feed(false, 100);
    input.feed(true, 90);
    QVERIFY(!input.feed(true, 104));
    QVERIFY(input.feed(true, 105));
    QCOMPARE(input.edgeTime(), qint64(100));
}

void tst_Debouncer::firstLevelAfterResetIsAcceptedWithoutEdge()
{
    Debouncer input(5);
    input.feed(false, 0);
    input.reset();
    QVERIFY(!input.feed(true, 1));
    QVERIFY(input.isOn());
}

QTEST_GUILESS_MAIN(tst_Debouncer)
#include "tst_Debouncer.moc"

// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/StickyRange.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

class tst_StickyRange : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void firstValuesSetTheRange();
    void rangeGrowsImmediately();
    void rangeShrinksOnlyAfterADelay();
    void interruptedQuietTimeDoesNotShrinkTheRange();
    void slightlySmallerValuesDoNotShrinkTheRange();
    void aConstantIsInTheMiddle();
    void invalidOrUnchangedValuesKeepTheRange();
    void endsAreRound();
};

void tst_StickyRange::firstValuesSetTheRange()
{
    StickyRange range;
    QVERIFY(range.fit(100.0, 102.0, 0));
    QVERIFY(range.minimum() < 100.0 && range.minimum() > 99.5);
    QVERIFY(range.maximum() > 102.0 && range.maximum() < 102.5);
    range.reset();
    QVERIFY(range.fit(-1.0, 1.0, 1));
    QVERIFY(range.maximum() < 2.0);
}

void tst_StickyRange::rangeGrowsImmediately()
{
    StickyRange range;
    range.fit(0.0, 1.0, 0);
    const double before = range.minimum();
    QVERIFY(range.fit(0.0, 5.0, 1));
    QVERIFY(range.maximum() > 5.0);
    QCOMPARE(range.minimum() <= before, true);
}

void tst_StickyRange::rangeShrinksOnlyAfterADelay()
{
    StickyRange range;
    range.fit(0.0, 10.0, 0);
    QVERIFY(!range.fit(0.0, 1.0, 100));
    QVERIFY(!range.fit(0.0, 1.0, 99 + StickyRange::patience));
    QVERIFY(range.maximum() > 10.0);
    QVERIFY(range.fit(0.0, 1.0, 100 + StickyRange::patience));
    QVERIFY(range.maximum() < 2.0);
}

void tst_StickyRange::interruptedQuietTimeDoesNotShrinkTheRange()
{
    StickyRange range;
    range.fit(0.0, 10.0, 0);
    range.fit(0.0, 1.0, 100);
    range.fit(0.0, 9.0, 1000);  // it was needed after all
    QVERIFY(!range.fit(0.0, 1.0, 100 + StickyRange::patience));
    QVERIFY(range.maximum() > 10.0);
}

void tst_StickyRange::slightlySmallerValuesDoNotShrinkTheRange()
{
    StickyRange range;
    range.fit(0.0, 10.0, 0);
    range.fit(0.0, 8.0, 1);
    QVERIFY(!range.fit(0.0, 8.0, 1 + 10 * StickyRange::patience));
}

void tst_StickyRange::aConstantIsInTheMiddle()
{
    StickyRange range;
    range.fit(0.0, 0.0, 0);
    QVERIFY(range.minimum() < -0.5 && range.maximum() > 0.5);
    range.reset();
    range.fit(1000.0, 1000.0, 0);
    QCOMPARE(0.5 * (range.minimum() + range.maximum()), 1000.0);
    QVERIFY(range.minimum() > 800.0 && range.minimum() < 950.0);
}

void tst_StickyRange::invalidOrUnchangedValuesKeepTheRange()
{
    StickyRange range;
    range.fit(2.0, 3.0, 0);
    const double before = range.minimum();
    QVERIFY(!range.fit(NAN, NAN, 1));
    QVERIFY(!range.fit(-INFINITY, INFINITY, 2));
    QVERIFY(!range.fit(2.0, 3.0, 3));
    QCOMPARE(range.minimum(), before);
}

void tst_StickyRange::endsAreRound()
{
    StickyRange range;
    range.fit(0.123, 9.87, 0);
    QCOMPARE(range.minimum(), -0.5);
    QCOMPARE(range.maximum(), 10.5);
}

QTEST_APPLESS_MAIN(tst_StickyRange)
#include "tst_StickyRange.moc"

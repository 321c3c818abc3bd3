// SPDX-License-Identifier: Apache-2.0
#include "node/session/Arming.h"
#include "node/session/BackOff.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

// The pauses between two attempts to connect, and the permission of a start.
class tst_BackOff : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void pausesGrowFromATenthToFiveSeconds();
    void timeoutGrowsFromTwoToSixteenSeconds();
    void pausesVaryRandomlyByTwentyPercent();
    void successResetsThePause();
    void aRefusalWaitsLongest();
    void aTokenIsValidForFiveSecondsOnly();
    void onlyTheNewestTokenCounts();
};

void tst_BackOff::pausesGrowFromATenthToFiveSeconds()
{
    BackOff pauses;
    QVector<qint64> found;
    for (int i = 0; i < 9; ++i)
        found << pauses.next(0.5).count();
    QCOMPARE(found, (QVector<qint64>{100, 200, 400, 800, 1600, 3200, 5000, 5000, 5000}));
}

void tst_BackOff::timeoutGrowsFromTwoToSixteenSeconds()
{
    BackOff pauses;
    QCOMPARE(pauses.patience(), std::chrono::milliseconds(2s));  // of the attempt that somebody wants now
    QVector<qint64> found;
    for (int i = 0; i < 6; ++i) {
        pauses.next(0.5);
        found << pauses.patience().count();
    }
    QCOMPARE(found, (QVector<qint64>{2000, 4000, 8000, 16000, 16000, 16000}));
    pauses.reset();
    QCOMPARE(pauses.patience(), std::chrono::milliseconds(2s));
}

void tst_BackOff::pausesVaryRandomlyByTwentyPercent()
{
    BackOff shortest;
    BackOff longest;
    for (int i = 0; i < 10; ++i) {
        const auto low = shortest.next(0.0);
        const auto high = longest.next(1.0);
        QVERIFY(low * 1.5 <= high + 1ms && high <= low * 1.5 + 2ms);  // 0.8 and 1.2
    }
    QCOMPARE(longest.next(1.0), 6000ms);
}

void tst_BackOff::successResetsThePause()
{
    BackOff pauses;
    for (int i = 0; i < 10; ++i)
        pauses.next(0.5);
    pauses.reset();
    QCOMPARE(pauses.next(0.5), 100ms);
}

void tst_BackOff::aRefusalWaitsLongest()
{
    BackOff pauses;
    QCOMPARE(pauses.afterRefusal(0.5), 5000ms);
    QCOMPARE(pauses.next(0.5), 5000ms);
}

void tst_BackOff::aTokenIsValidForFiveSecondsOnly()
{
    Arming arming;
    QVERIFY(!arming.permits(0, 0));
    arming.arm(7, 1'000);
    QVERIFY(arming.permits(7, 1'000));
    QVERIFY(arming.permits(7, 1'000 + 4'999'999'999));
    QVERIFY(!arming.permits(7, 1'000 + 5'000'000'000));
    QVERIFY(!arming.isArmed(1'000 + 5'000'000'000));
}

void tst_BackOff::onlyTheNewestTokenCounts()
{
    Arming arming;
    arming.arm(7, 0);
    arming.arm(8, 10);
    QVERIFY(!arming.permits(7, 20));
    QVERIFY(!arming.permits(0, 20));
    QVERIFY(arming.permits(8, 20));
    arming.disarm();
    QVERIFY(!arming.permits(8, 20));
    QVERIFY(!arming.permits(0, 20));
}

QTEST_GUILESS_MAIN(tst_BackOff)
#include "tst_BackOff.moc"

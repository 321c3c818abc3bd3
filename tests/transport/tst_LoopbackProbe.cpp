// SPDX-License-Identifier: Apache-2.0
#include "transport/LoopbackProbe.h"

#include <QtTest/QtTest>

#include <vector>

class tst_LoopbackProbe : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyDatagramReturns_data();
    void everyDatagramReturns();
    void durationIsThatOfTheClock();
};

void tst_LoopbackProbe::everyDatagramReturns_data()
{
    QTest::addColumn<int>("count");
    QTest::newRow("none") << 0;
    QTest::newRow("one") << 1;
    QTest::newRow("many") << 500;
}

void tst_LoopbackProbe::everyDatagramReturns()
{
    QFETCH(int, count);
    int came = 0;
    QVERIFY(qplc::probeLoopback(
        count, [] { return 0; }, [&came](std::int64_t) { ++came; }));
    QCOMPARE(came, count);
}

void tst_LoopbackProbe::durationIsThatOfTheClock()
{
    std::int64_t time = 0;
    std::vector<std::int64_t> durations;
    const auto clock = [&time] { return time += 7; };  // is looked at before and after each round trip
    QVERIFY(qplc::probeLoopback(3, clock, [&durations](std::int64_t duration) { durations.push_back(duration); }));
    QCOMPARE(durations, (std::vector<std::int64_t>{7, 7, 7}));
}

QTEST_APPLESS_MAIN(tst_LoopbackProbe)
#include "tst_LoopbackProbe.moc"

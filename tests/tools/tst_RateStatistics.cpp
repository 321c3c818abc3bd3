// SPDX-License-Identifier: Apache-2.0
#include "tools/RateStatistics.h"

#include <QtTest/QtTest>

using tools::RateStatistics;

// Rows of arrivals whose statistics are known.
class tst_RateStatistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void emptyStatisticsHaveNoRate();
    void oneCycleHasNoRate();
    void evenCyclesHaveTheirRateAndNoDeviation();
    void deviationIsTheSampleStandardDeviation();
    void smallDeviationsAtLargeTimesKeepTheirPrecision();
    void lostCyclesAreNamedAndMakeNoInterval();
    void gapsAreNamedUpToALimit_data();
    void gapsAreNamedUpToALimit();
    void newPhaseBeginsAnew();

private:
    static constexpr qint64 ms = 1'000'000;
};

void tst_RateStatistics::emptyStatisticsHaveNoRate()
{
    const RateStatistics rate;
    QCOMPARE(rate.cycles(), quint64(0));
    QCOMPARE(rate.rate(), 0.0);
    QCOMPARE(rate.deviation(), 0.0);
    QCOMPARE(rate.gapsText(), QString());
}

void tst_RateStatistics::oneCycleHasNoRate()
{
    RateStatistics rate;
    rate.add({7, 5 * ms});
    QCOMPARE(rate.cycles(), quint64(1));
    QCOMPARE(rate.rate(), 0.0);
    QCOMPARE(rate.intervals(), quint64(0));
}

void tst_RateStatistics::evenCyclesHaveTheirRateAndNoDeviation()
{
    RateStatistics rate;
    for (int i = 0; i < 101; ++i)
        rate.add({quint64(i), i * 10 * ms});
    QCOMPARE(rate.cycles(), quint64(101));
    QCOMPARE(rate.duration(), 1.0);
    QCOMPARE(rate.rate(), 100.0);
    QCOMPARE(rate.mean(), 1e7);
    QCOMPARE(rate.minimum(), 1e7);
    QCOMPARE(rate.maximum(), 1e7);
    QCOMPARE(rate.deviation(), 0.0);
    QCOMPARE(rate.lost(), quint64(0));
}

void tst_RateStatistics::deviationIsTheSampleStandardDeviation()
{
    RateStatistics rate;
    qint64 time = 0;
    quint64 cycle = 0;
    rate.add({cycle, time});
    for (const qint64 interval : {2, 4, 4, 4, 5, 5, 7, 9})
        rate.add({++cycle, time += interval});
    QCOMPARE(rate.mean(), 5.0);
    QCOMPARE(rate.minimum(), 2.0);
    QCOMPARE(rate.maximum(), 9.0);
    QVERIFY(qAbs(rate.deviation() - std::sqrt(32.0 / 7.0)) < 1e-12);
}

void tst_RateStatistics::smallDeviationsAtLargeTimesKeepTheirPrecision()
{
    RateStatistics rate;
    qint64 time = 4'000'000'000'000'000'000;  // 127 years
    for (int i = 0; i < 100001; ++i)
        rate.add({quint64(i), time += 1'000'000'000 + (i % 2 == 0 ? 1 : -1)});
    QVERIFY2(qAbs(rate.deviation() - 1.0) < 1e-4, qPrintable(QString::number(rate.deviation(), 'g', 17)));
}

void tst_RateStatistics::lostCyclesAreNamedAndMakeNoInterval()
{
    RateStatistics rate;
    for (const int cycle : {10, 11, 13, 14, 20, 21})
        rate.add({quint64(cycle), cycle * ms});
    QCOMPARE(rate.lost(), quint64(6));
    QCOMPARE(rate.gapsText(), QStringLiteral("12, 15-19"));
    QCOMPARE(rate.gaps(), (QJsonArray{QJsonArray{12, 12}, QJsonArray{15, 19}}));
    QCOMPARE(rate.intervals(), quint64(3));
    QCOMPARE(rate.maximum(), 1e6);
    QCOMPARE(rate.rate(), 1000.0);  // the master's, not that of the ear
}

void tst_RateStatistics::gapsAreNamedUpToALimit_data()
{
    QTest::addColumn<int>("gaps");
    QTest::addColumn<bool>("hasMore");
    QTest::newRow("one below") << RateStatistics::mostGaps - 1 << false;
    QTest::newRow("all") << RateStatistics::mostGaps << false;
    QTest::newRow("one above") << RateStatistics::mostGaps + 1 << true;
}

void tst_RateStatistics::gapsAreNamedUpToALimit()
{
    QFETCH(int, gaps);
    QFETCH(bool, hasMore);
    RateStatistics rate;
    for (int i = 0; i <= gaps; ++i)
        rate.add({quint64(2 * i), 2 * i * ms});
    QCOMPARE(rate.lost(), quint64(gaps));
    QCOMPARE(rate.gapsText().endsWith(QLatin1String(", ...")), hasMore);
    QCOMPARE(rate.gaps().size(), qMin(gaps, RateStatistics::mostGaps));
}

void tst_RateStatistics::newPhaseBeginsAnew()
{
    RateStatistics rate;
    for (const int cycle : {100, 105})
        rate.add({quint64(cycle), cycle * ms});
    for (int cycle = 0; cycle < 11; ++cycle)
        rate.add({quint64(cycle), (500 + cycle) * ms});
    QCOMPARE(rate.lost(), quint64(0));
    QCOMPARE(rate.cycles(), quint64(11));
    QCOMPARE(rate.duration(), 0.010);
}

QTEST_APPLESS_MAIN(tst_RateStatistics)
#include "tst_RateStatistics.moc"

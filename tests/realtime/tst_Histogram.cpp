// SPDX-License-Identifier: Apache-2.0
#include "realtime/Histogram.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

using qplc::Histogram;

Q_DECLARE_METATYPE(std::vector<std::int64_t>)

namespace {

using Values = std::vector<std::int64_t>;

template<typename Draw>
Values values(int count, Draw draw)
{
    std::mt19937_64 random(2026);
    Values result;
    for (int i = 0; i < count; ++i)
        result.push_back(draw(random));
    return result;
}

/// The value of rank ceil(q n) among the sorted \a values, at least the first.
std::int64_t exactQuantile(const Values &sorted, double q)
{
    const double rank = std::ceil(q * double(sorted.size()));
    return sorted[std::size_t(std::clamp(rank, 1.0, double(sorted.size()))) - 1];
}

void record(Histogram &histogram, const Values &values)
{
    for (const std::int64_t value : values)
        histogram.record(value);
}

}  // namespace

class tst_Histogram : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void emptyHistogramReturnsZero();
    void quantilesAgreeWithAnExactSort_data();
    void quantilesAgreeWithAnExactSort();
    void valuesAroundPowersOfTwoKeepTheirPrecision();
    void quantileAcceptsAnyFraction_data();
    void quantileAcceptsAnyFraction();
    void clearForgetsEverything();
    void sumOfHugeValuesStaysAtItsLimit();
    void readerSeesAConsistentStateWhileItIsRecorded();
};

void tst_Histogram::emptyHistogramReturnsZero()
{
    const Histogram histogram;
    QCOMPARE(histogram.count(), std::uint64_t(0));
    QCOMPARE(histogram.minimum(), std::int64_t(0));
    QCOMPARE(histogram.maximum(), std::int64_t(0));
    QCOMPARE(histogram.mean(), 0.0);
    QCOMPARE(histogram.quantile(0.5), std::int64_t(0));
}

void tst_Histogram::quantilesAgreeWithAnExactSort_data()
{
    using Random = std::mt19937_64;
    QTest::addColumn<Values>("recorded");
    QTest::newRow("one value") << Values{123'456};
    QTest::newRow("one huge value") << Values{INT64_MAX};
    QTest::newRow("zeros") << Values(1000, 0);
    QTest::newRow("negative values count as zero") << Values{-1, -1000, INT64_MIN, 5};
    QTest::newRow("0 ... 31 exactly") << values(1000, [](Random &r) { return std::int64_t(r() % 32); });
    QTest::newRow("borders of bins") << Values{31, 32, 33, 63, 64, 65, 66, 67, 127, 128, 131, 132};
    QTest::newRow("uniform, microseconds") << values(20000, [](Random &r) { return std::int64_t(r() % 1'000'000); });
    QTest::newRow("all magnitudes") << values(20000, [](Random &r) { return std::int64_t(r() >> (1 + r() % 63)); });
    QTest::newRow("latencies with a tail")
        << values(20000, [](Random &r) { return std::int64_t(std::lognormal_distribution<double>(10.0, 2.0)(r)); });
    QTest::newRow("two peaks") << values(10000,
                                         [](Random &r) { return std::int64_t(r() % 100 < 99 ? 10'000 : 28'305'000); });
}

void tst_Histogram::quantilesAgreeWithAnExactSort()
{
    QFETCH(Values, recorded);
    const auto histogram = std::make_unique<Histogram>();
    record(*histogram, recorded);
    for (std::int64_t &value : recorded)
        value = std::max<std::int64_t>(value, 0);
    std::sort(recorded.begin(), recorded.end());

    QCOMPARE(histogram->count(), std::uint64_t(recorded.size()));
    QCOMPARE(histogram->minimum(), recorded.front());
    QCOMPARE(histogram->maximum(), recorded.back());
    if (recorded.back() < INT64_MAX / 100'000) {
        const auto sum = std::accumulate(recorded.begin(), recorded.end(), std::int64_t(0));
        QCOMPARE(histogram->mean(), double(sum) / double(recorded.size()));
    }
    for (const double q : {0.0, 0.001, 0.01, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999, 0.9999, 1.0}) {
        const std::int64_t exact = exactQuantile(recorded, q);
        const std::int64_t quantile = histogram->quantile(q);
        QVERIFY2(quantile >= exact, qPrintable(QStringLiteral("q %1: %2 < %3").arg(q).arg(quantile).arg(exact)));
        QVERIFY2(quantile - exact <= exact / 32,
                 qPrintable(QStringLiteral("q %1: %2 for %3").arg(q).arg(quantile).arg(exact)));
    }
}

void tst_Histogram::valuesAroundPowersOfTwoKeepTheirPrecision()
{
    for (int exponent = 0; exponent < 63; ++exponent) {
        for (const std::int64_t offset : {-1, 0, 1}) {
            const std::int64_t value = (std::int64_t(1) << exponent) + offset;
            Histogram histogram;
            histogram.record(value);
            histogram.record(INT64_MAX);  // so that the maximum does not hide the border
            const std::int64_t border = histogram.quantile(0.5);
            QVERIFY2(border >= value && border - value <= value / 32, qPrintable(QString::number(value)));
        }
    }
}

void tst_Histogram::quantileAcceptsAnyFraction_data()
{
    QTest::addColumn<double>("q");
    QTest::addColumn<qint64>("expected");  // of 1, 2, 3, 4
    QTest::newRow("zero: at least one value") << 0.0 << qint64(1);
    QTest::newRow("a quarter") << 0.25 << qint64(1);
    QTest::newRow("above a quarter") << 0.2500001 << qint64(2);
    QTest::newRow("half") << 0.5 << qint64(2);
    QTest::newRow("one") << 1.0 << qint64(4);
    QTest::newRow("negative") << -3.0 << qint64(1);
    QTest::newRow("above one") << 17.0 << qint64(4);
    QTest::newRow("not a number") << double(qQNaN()) << qint64(1);
    QTest::newRow("infinite") << double(qInf()) << qint64(4);
}

void tst_Histogram::quantileAcceptsAnyFraction()
{
    QFETCH(double, q);
    Histogram histogram;
    record(histogram, {4, 1, 3, 2});
    QTEST(qint64(histogram.quantile(q)), "expected");
}

void tst_Histogram::clearForgetsEverything()
{
    Histogram histogram;
    record(histogram, {5, 1'000'000, INT64_MAX});
    histogram.clear();
    QCOMPARE(histogram.count(), std::uint64_t(0));
    QCOMPARE(histogram.minimum(), std::int64_t(0));
    QCOMPARE(histogram.maximum(), std::int64_t(0));
    QCOMPARE(histogram.mean(), 0.0);
    QCOMPARE(histogram.quantile(1.0), std::int64_t(0));
    record(histogram, {7, 9});
    QCOMPARE(histogram.minimum(), std::int64_t(7));
    QCOMPARE(histogram.maximum(), std::int64_t(9));
    QCOMPARE(histogram.mean(), 8.0);
}

void tst_Histogram::sumOfHugeValuesStaysAtItsLimit()
{
    Histogram histogram;
    record(histogram, {INT64_MAX, INT64_MAX, 1});
    QCOMPARE(histogram.mean(), double(INT64_MAX) / 3.0);
    QCOMPARE(histogram.quantile(1.0), INT64_MAX);
}

void tst_Histogram::readerSeesAConsistentStateWhileItIsRecorded()
{
    constexpr std::uint64_t count = 100'000;
    const auto histogram = std::make_unique<Histogram>();
    std::atomic<bool> done{false};
    std::thread recorder([&] {
        for (std::uint64_t i = 0; i < count; ++i)
            histogram->record(1000 + std::int64_t(i));  // rising: the newest value is the maximum
        done = true;
    });
    int wrong = 0;
    while (!done) {
        const std::uint64_t counted = histogram->count();
        if (counted == 0)
            continue;
        const std::int64_t newest = 1000 + std::int64_t(counted) - 1;
        wrong += histogram->minimum() != 1000;
        wrong += histogram->maximum() < newest;
        wrong += histogram->quantile(1.0) < newest;
        wrong += histogram->mean() < 1000.0;
    }
    recorder.join();
    QCOMPARE(wrong, 0);
    QCOMPARE(histogram->count(), count);
    QCOMPARE(histogram->quantile(1.0), std::int64_t(1000 + count - 1));
}

QTEST_APPLESS_MAIN(tst_Histogram)
#include "tst_Histogram.moc"

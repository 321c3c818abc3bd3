// SPDX-License-Identifier: Apache-2.0
#include "realtime/DurationStatistics.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

using qplc::DurationStatistics;
using qplc::SlidingHistogram;

namespace {

constexpr std::int64_t Second = 1'000'000'000;

struct Measured
{
    std::int64_t value;
    std::int64_t time;
};

/// The values of the second of \a now and of the nine before it, sorted.
std::vector<std::int64_t> window(const std::vector<Measured> &all, std::int64_t now)
{
    std::vector<std::int64_t> values;
    for (const Measured &measured : all) {
        if (measured.time / Second > now / Second - 10 && measured.time / Second <= now / Second)
            values.push_back(std::max<std::int64_t>(measured.value, 0));
    }
    std::sort(values.begin(), values.end());
    return values;
}

bool isWithin(std::int64_t figure, const std::vector<std::int64_t> &sorted, double q, std::int64_t parts)
{
    const double rank = std::clamp(std::ceil(q * double(sorted.size())), 1.0, double(sorted.size()));
    const std::int64_t exact = sorted[std::size_t(rank) - 1];
    return figure >= exact && figure - exact <= exact / parts;
}

/// What differs from an exact sort; empty: nothing.
QString difference(const QPlcDistribution &figures, const std::vector<std::int64_t> &sorted, std::int64_t parts)
{
    if (figures.count != sorted.size())
        return QStringLiteral("count %1 for %2").arg(figures.count).arg(sorted.size());
    if (sorted.empty())
        return figures.maximum == 0 && figures.p99 == 0 ? QString() : QStringLiteral("figures of nothing");
    const auto sum = double(std::accumulate(sorted.begin(), sorted.end(), std::int64_t(0)));
    if (figures.minimum != sorted.front() || figures.maximum != sorted.back()
        || figures.mean != sum / double(sorted.size()))
        return QStringLiteral("extremes or mean");
    const std::pair<std::int64_t, double> quantiles[]
        = {{figures.p001, 0.001}, {figures.p01, 0.01}, {figures.p50, 0.5}, {figures.p99, 0.99}, {figures.p999, 0.999}};
    for (const auto &[figure, q] : quantiles) {
        if (!isWithin(figure, sorted, q, parts))
            return QStringLiteral("quantile %1: %2").arg(q).arg(figure);
    }
    quint64 inBins = 0;
    qint64 border = -1;
    for (const QPlcDistribution::Bin &bin : figures.bins) {
        if (bin.count == 0 || bin.upperBorder <= border)
            return QStringLiteral("bins");
        border = bin.upperBorder;
        inBins += bin.count;
    }
    return inBins == figures.count ? QString() : QStringLiteral("sum of the bins");
}

}  // namespace

class tst_DurationStatistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void emptyStatisticsAreZero();
    void figuresAgreeWithAnExactSortAtAnyTime_data();
    void figuresAgreeWithAnExactSortAtAnyTime();
    void windowCoversTheLastTenSeconds();
    void pausesEmptyTheWindow();
    void hugeValuesKeepTheirMaximum();
    void valuesBeforeTheClockBeganCount();
    void binsAreGivenWhenAskedFor();
    void clearForgetsEverything();
    void readerSeesWholeSecondsWhileTheWindowSlides();
};

void tst_DurationStatistics::emptyStatisticsAreZero()
{
    const DurationStatistics statistics;
    const QPlcDurationStatistics figures = statistics.read(5 * Second, QPlcDistribution::WithBins);
    QCOMPARE(difference(figures.sinceStart, {}, 32), QString());
    QCOMPARE(difference(figures.last10s, {}, 8), QString());
    QVERIFY(figures.last10s.bins.isEmpty());
}

void tst_DurationStatistics::figuresAgreeWithAnExactSortAtAnyTime_data()
{
    QTest::addColumn<qint64>("period");
    QTest::newRow("1 ms") << qint64(1'000'000);
    QTest::newRow("prime, 0.1 s") << qint64(99'999'989);
    QTest::newRow("3 s") << qint64(3 * Second);
    QTest::newRow("longer than the window") << qint64(11 * Second);
}

void tst_DurationStatistics::figuresAgreeWithAnExactSortAtAnyTime()
{
    QFETCH(qint64, period);
    std::mt19937_64 random{quint64(period)};
    const auto statistics = std::make_unique<DurationStatistics>();
    std::vector<Measured> all;
    std::vector<std::int64_t> values;
    std::int64_t now = std::int64_t(random() % 1'000'000'000'000);
    for (int i = 0; i < 30'000; ++i) {
        const std::int64_t value = std::int64_t(random() >> (28 + random() % 36)) - 100;
        now += std::int64_t(random() % std::uint64_t(2 * period));
        statistics->record(value, now);
        all.push_back({value, now});
        values.push_back(std::max<std::int64_t>(value, 0));
        if (i % 997 != 0 && i != 29'999)
            continue;
        std::vector<std::int64_t> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        const QPlcDurationStatistics figures = statistics->read(now, QPlcDistribution::WithBins);
        QCOMPARE(difference(figures.sinceStart, sorted, 32), QString());
        QCOMPARE(difference(figures.last10s, window(all, now), 8), QString());
    }
}

void tst_DurationStatistics::windowCoversTheLastTenSeconds()
{
    SlidingHistogram histogram;
    for (std::int64_t second = 0; second < 25; ++second)
        histogram.record(second, second * Second);
    QCOMPARE(histogram.distribution(24 * Second).count, quint64(10));
    QCOMPARE(histogram.distribution(24 * Second).minimum, qint64(15));
    QCOMPARE(histogram.distribution(25 * Second - 1).minimum, qint64(15));
    QCOMPARE(histogram.distribution(25 * Second).minimum, qint64(16));  // nothing came in the newest second
    QCOMPARE(histogram.distribution(33 * Second).count, quint64(1));
    QCOMPARE(histogram.distribution(34 * Second).count, quint64(0));
}

void tst_DurationStatistics::pausesEmptyTheWindow()
{
    SlidingHistogram histogram;
    for (int i = 0; i < 100; ++i)
        histogram.record(1000, i * Second / 10);
    histogram.record(7, 1'000'003 * Second);
    QCOMPARE(histogram.distribution(1'000'003 * Second).count, quint64(1));
    QCOMPARE(histogram.distribution(1'000'003 * Second).maximum, qint64(7));
}

void tst_DurationStatistics::hugeValuesKeepTheirMaximum()
{
    SlidingHistogram histogram;
    histogram.record(5, 0);
    histogram.record(1'000 * Second, 0);
    histogram.record(INT64_MAX, 0);
    const QPlcDistribution figures = histogram.distribution(0);
    QCOMPARE(figures.p50, INT64_MAX);  // beyond 69 s all values share a bin, whose border is the maximum
    QCOMPARE(figures.maximum, INT64_MAX);
    QCOMPARE(figures.minimum, qint64(5));
}

void tst_DurationStatistics::valuesBeforeTheClockBeganCount()
{
    SlidingHistogram histogram;
    histogram.record(5, -30 * Second);
    histogram.record(6, -1);
    QCOMPARE(histogram.distribution(0).count, quint64(2));
}

void tst_DurationStatistics::binsAreGivenWhenAskedFor()
{
    DurationStatistics statistics;
    statistics.record(1000, 0);
    QVERIFY(statistics.read(0, QPlcDistribution::FiguresOnly).sinceStart.bins.isEmpty());
    QVERIFY(statistics.read(0, QPlcDistribution::FiguresOnly).last10s.bins.isEmpty());
    const QPlcDurationStatistics figures = statistics.read(0, QPlcDistribution::WithBins);
    QCOMPARE(figures.sinceStart.bins.size(), 1);
    QCOMPARE(figures.sinceStart.bins.at(0).upperBorder, qint64(1007));  // 16 wide from 992 on
    QCOMPARE(figures.last10s.bins.at(0).upperBorder, qint64(1023));     // 64 wide from 960 on
    QCOMPARE(figures.last10s.bins.at(0).count, quint64(1));
}

void tst_DurationStatistics::clearForgetsEverything()
{
    DurationStatistics statistics;
    for (int i = 0; i < 30; ++i)
        statistics.record(1000 * i, i * Second);
    statistics.clear();
    QCOMPARE(statistics.read(29 * Second, QPlcDistribution::FiguresOnly).last10s.count, quint64(0));
    statistics.record(3, 2 * Second);
    const QPlcDurationStatistics figures = statistics.read(2 * Second, QPlcDistribution::FiguresOnly);
    QCOMPARE(figures.sinceStart.count, quint64(1));
    QCOMPARE(figures.last10s.maximum, qint64(3));
}

void tst_DurationStatistics::readerSeesWholeSecondsWhileTheWindowSlides()
{
    constexpr int perSecond = 20;
    constexpr std::int64_t seconds = 20'000;
    const auto histogram = std::make_unique<SlidingHistogram>();
    std::atomic<std::int64_t> newest{0};
    std::thread recorder([&] {
        for (std::int64_t i = 0; i < seconds * perSecond; ++i) {
            histogram->record(i / perSecond, i * (Second / perSecond));  // the value is its second
            newest.store(i * (Second / perSecond), std::memory_order_release);
        }
    });
    int wrong = 0;
    for (std::int64_t now = 0; now < (seconds * perSecond - 1) * (Second / perSecond);) {
        now = newest.load(std::memory_order_acquire);
        const QPlcDistribution figures = histogram->distribution(now);
        if (figures.count == 0)
            continue;  // everything of that time has been overwritten meanwhile
        const std::int64_t second = now / Second;
        wrong += figures.minimum < second - 9;
        wrong += figures.maximum > second;
        wrong += figures.count > 10 * perSecond;
        wrong += figures.mean < double(figures.minimum) || figures.mean > double(figures.maximum);
    }
    recorder.join();
    QCOMPARE(wrong, 0);
    QCOMPARE(histogram->distribution(newest).count, quint64(10 * perSecond));
}

QTEST_APPLESS_MAIN(tst_DurationStatistics)
#include "tst_DurationStatistics.moc"

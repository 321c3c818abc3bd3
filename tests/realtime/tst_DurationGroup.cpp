// SPDX-License-Identifier: Apache-2.0
#include "realtime/DurationGroup.h"

#include <QtTest/QtTest>

#include <atomic>
#include <memory>
#include <thread>

namespace {

constexpr std::int64_t Millisecond = 1'000'000;

enum { First, Second };
using Group = qplc::DurationGroup<2>;

std::uint64_t countOf(const Group &group, std::size_t duration)
{
    return group[duration].sinceStart().count();
}

}  // namespace

class tst_DurationGroup : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void valuesAreSeenWhenTheyAreFolded();
    void aDurationThatWasNotMeasuredIsNotCounted();
    void manyValuesFoldByThemselves();
    void noValueWaitsForLong();
    void eachValueCountsInItsOwnSecond();
    void clearDiscardsPendingValues();
    void concurrentReadersSeeConsistentValues();
};

void tst_DurationGroup::valuesAreSeenWhenTheyAreFolded()
{
    const auto group = std::make_unique<Group>();
    group->record(0, {5, 7});
    group->record(1, {6, -3});
    QCOMPARE(countOf(*group, First), std::uint64_t(0));
    group->fold();
    QCOMPARE(countOf(*group, First), std::uint64_t(2));
    QCOMPARE((*group)[First].sinceStart().maximum(), std::int64_t(6));
    QCOMPARE((*group)[Second].sinceStart().maximum(), std::int64_t(7));
    QCOMPARE((*group)[Second].sinceStart().minimum(), std::int64_t(0));
    group->fold();  // once is enough
    QCOMPARE(countOf(*group, First), std::uint64_t(2));
}

void tst_DurationGroup::aDurationThatWasNotMeasuredIsNotCounted()
{
    const auto group = std::make_unique<Group>();
    group->record(0, {5, Group::None});
    group->fold();
    QCOMPARE(countOf(*group, First), std::uint64_t(1));
    QCOMPARE(countOf(*group, Second), std::uint64_t(0));
}

void tst_DurationGroup::manyValuesFoldByThemselves()
{
    const auto group = std::make_unique<Group>();
    for (int i = 0; i < 1000; ++i)
        group->record(i, {i, i});
    QVERIFY(countOf(*group, First) > 900);
    group->fold();
    QCOMPARE(countOf(*group, First), std::uint64_t(1000));
}

void tst_DurationGroup::noValueWaitsForLong()
{
    const auto group = std::make_unique<Group>();
    group->record(0, {1, 1});
    group->record(99 * Millisecond, {2, 2});
    QCOMPARE(countOf(*group, First), std::uint64_t(0));
    group->record(100 * Millisecond, {3, 3});
    QCOMPARE(countOf(*group, First), std::uint64_t(3));
}

void tst_DurationGroup::eachValueCountsInItsOwnSecond()
{
    const auto group = std::make_unique<Group>();
    group->record(999 * Millisecond, {1, 1});
    group->record(1001 * Millisecond, {2, 2});
    group->fold();
    const std::int64_t tenSecondsOn = 10'500 * Millisecond;  // the first of the two is over
    QCOMPARE((*group)[First].read(tenSecondsOn, QPlcDistribution::FiguresOnly).last10s.count, std::uint64_t(1));
    QCOMPARE((*group)[First].read(tenSecondsOn, QPlcDistribution::FiguresOnly).last10s.maximum, std::int64_t(2));
}

void tst_DurationGroup::clearDiscardsPendingValues()
{
    const auto group = std::make_unique<Group>();
    group->record(0, {1, 1});
    group->clear();
    group->fold();
    QCOMPARE(countOf(*group, First), std::uint64_t(0));
}

void tst_DurationGroup::concurrentReadersSeeConsistentValues()
{
    const auto group = std::make_unique<Group>();
    std::atomic<bool> ended{false};
    std::thread recorder([&] {
        for (int i = 0; i < 50'000; ++i)
            group->record(i * 1000, {4, 4});
        group->fold();
        ended = true;
    });
    std::uint64_t before = 0;
    while (!ended) {
        const std::uint64_t now = countOf(*group, Second);
        QVERIFY(now >= before);
        QVERIFY(now == 0 || (*group)[Second].sinceStart().maximum() == 4);
        before = now;
    }
    recorder.join();
    QCOMPARE(countOf(*group, Second), std::uint64_t(50'000));
}

QTEST_APPLESS_MAIN(tst_DurationGroup)
#include "tst_DurationGroup.moc"

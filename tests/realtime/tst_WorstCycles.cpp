// SPDX-License-Identifier: Apache-2.0
#include "realtime/WorstCycles.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <memory>
#include <random>
#include <thread>

using qplc::CycleRecord;
using qplc::WorstCycles;

namespace {

/// A record all of whose fields follow from its number and cost, so that a mixture of two is seen.
CycleRecord recordOf(std::uint64_t cycle, std::int64_t cost)
{
    CycleRecord record;
    record.cycle = cycle;
    record.skipped = cycle + 1;
    record.lateness = cost;
    record.execution = cost + 1;
    record.roundTrip = cost + 2;
    record.slack = cost + 3;
    for (std::size_t stage = 0; stage < qplc::CycleStageCount; ++stage)
        record.stages[stage] = cost + 4 + std::int64_t(stage);
    return record;
}

bool isWhole(const CycleRecord &record)
{
    const CycleRecord expected = recordOf(record.cycle, record.lateness);
    return record.skipped == expected.skipped && record.execution == expected.execution
        && record.roundTrip == expected.roundTrip && record.slack == expected.slack && record.stages == expected.stages;
}

}  // namespace

class tst_WorstCycles : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void newListOfWorstCyclesIsEmpty();
    void worstCyclesAgreeWithAFullSort_data();
    void worstCyclesAgreeWithAFullSort();
    void earlierCycleIsKeptAtEqualCost();
    void clearForgetsEverything();
    void readerSeesWholeRecordsWhileTheyAreReplaced();
};

void tst_WorstCycles::newListOfWorstCyclesIsEmpty()
{
    const WorstCycles worst;
    QVERIFY(worst.read().empty());
}

void tst_WorstCycles::worstCyclesAgreeWithAFullSort_data()
{
    QTest::addColumn<int>("count");
    QTest::addColumn<quint64>("range");
    for (const int count : {1, 15, 16, 17, 1000, 100'000})
        QTest::addRow("%d different costs", count) << count << (quint64(1) << 40);
    QTest::newRow("many equal costs") << 10'000 << quint64(20);
    QTest::newRow("all equal") << 1000 << quint64(1);
}

void tst_WorstCycles::worstCyclesAgreeWithAFullSort()
{
    QFETCH(int, count);
    QFETCH(quint64, range);
    std::mt19937_64 random(quint64(count) + range);
    WorstCycles worst;
    std::vector<std::pair<std::int64_t, std::uint64_t>> all;  // cost, cycle
    for (int i = 0; i < count; ++i) {
        const auto cost = std::int64_t(random() % range);
        worst.offer(cost, recordOf(std::uint64_t(i), cost));
        all.emplace_back(cost, std::uint64_t(i));
    }
    std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    all.resize(std::min(all.size(), WorstCycles::Count));
    const std::vector<CycleRecord> kept = worst.read();
    QCOMPARE(kept.size(), all.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        QCOMPARE(kept[i].lateness, all[i].first);
        QCOMPARE(kept[i].cycle, all[i].second);
        QVERIFY(isWhole(kept[i]));
    }
}

void tst_WorstCycles::earlierCycleIsKeptAtEqualCost()
{
    WorstCycles worst;
    for (std::uint64_t cycle = 0; cycle < 100; ++cycle)
        worst.offer(5, recordOf(cycle, 5));
    worst.offer(6, recordOf(100, 6));
    const std::vector<CycleRecord> kept = worst.read();
    QCOMPARE(kept.at(0).cycle, std::uint64_t(100));
    for (std::size_t i = 1; i < kept.size(); ++i)
        QCOMPARE(kept[i].cycle, std::uint64_t(i - 1));
}

void tst_WorstCycles::clearForgetsEverything()
{
    WorstCycles worst;
    for (std::uint64_t cycle = 0; cycle < 100; ++cycle)
        worst.offer(1'000'000, recordOf(cycle, 1'000'000));
    worst.clear();
    QVERIFY(worst.read().empty());
    worst.offer(0, recordOf(3, 0));
    QCOMPARE(worst.read().size(), std::size_t(1));
}

void tst_WorstCycles::readerSeesWholeRecordsWhileTheyAreReplaced()
{
    constexpr std::int64_t count = 2'000'000;
    const auto worst = std::make_unique<WorstCycles>();
    std::atomic<bool> done{false};
    std::thread offering([&] {
        for (std::int64_t i = 0; i < count; ++i)
            worst->offer(i, recordOf(std::uint64_t(i), i));  // always a new worst one
        done = true;
    });
    int wrong = 0;
    while (!done) {
        for (const CycleRecord &record : worst->read())
            wrong += isWhole(record) ? 0 : 1;
    }
    offering.join();
    QCOMPARE(wrong, 0);
    QCOMPARE(worst->read().front().cycle, std::uint64_t(count - 1));
    QCOMPARE(worst->read().back().cycle, std::uint64_t(count) - WorstCycles::Count);
}

QTEST_APPLESS_MAIN(tst_WorstCycles)
#include "tst_WorstCycles.moc"

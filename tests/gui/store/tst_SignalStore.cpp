// SPDX-License-Identifier: Apache-2.0
#include "ThreadCosts.h"
#include "gui/store/SignalStore.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <malloc.h>
#include <random>
#include <vector>

using qplc::SignalStore;
using Row = SignalStore::Row;
using Time = SignalStore::Time;

namespace {

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

/// All rows that were ever taken: what a store is compared with.
struct History
{
    struct Entry
    {
        Time time;
        bool beginsAnew;
        std::vector<float> values;
    };

    std::vector<Entry> entries;

    SignalStore::Range range(int channel, Row begin, Row end) const
    {
        SignalStore::Range range{noValue, noValue};
        for (Row row = begin; row < end; ++row) {
            range.minimum = std::fmin(range.minimum, entries[row].values[std::size_t(channel)]);
            range.maximum = std::fmax(range.maximum, entries[row].values[std::size_t(channel)]);
        }
        return range;
    }
    Row rowAt(Time time, Row first) const
    {
        Row row = first;
        while (row < entries.size() && entries[row].time < time)
            ++row;
        return row;
    }
    Row nextBeginAnew(Row begin, Row end) const
    {
        while (begin < end && !entries[begin].beginsAnew)
            ++begin;
        return begin;
    }
};

bool isSame(float a, float b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

bool isSame(SignalStore::Range a, SignalStore::Range b)
{
    return isSame(a.minimum, b.minimum) && isSame(a.maximum, b.maximum);
}

/// A store that is filled at random, beside the truth.
class Trial
{
public:
    Trial(int channels, int capacity, unsigned seed)
        : store(channels, capacity)
        , m_random(seed)
        , m_values(std::size_t(channels))
    {
    }

    Row below(Row limit) { return limit == 0 ? 0 : m_random() % limit; }

    void append()
    {
        if (below(50) == 0)
            interrupt();
        if (below(60) == 0)
            m_nanRows = int(below(40));
        m_nanRows = std::max(0, m_nanRows - 1);
        m_time += 1 + Time(below(1000));
        for (float &value : m_values)
            value = m_nanRows > 0 || below(20) == 0 ? noValue : float(below(2001)) - 1000.0F;
        QVERIFY(store.append(m_time, m_values.data()));
        history.entries.push_back({m_time, m_interrupted, m_values});
        m_interrupted = false;
    }
    void interrupt()
    {
        store.interrupt();
        m_interrupted = true;
    }

    void compareRows() const
    {
        for (Row row = store.firstRow(); row < store.endRow(); ++row) {
            QCOMPARE(store.time(row), history.entries[row].time);
            QCOMPARE(store.beginsAnew(row), history.entries[row].beginsAnew);
            for (int channel = 0; channel < store.channels(); ++channel)
                QVERIFY(isSame(store.value(channel, row), history.entries[row].values[std::size_t(channel)]));
        }
    }
    void compareRange(Row begin, Row end)
    {
        for (int channel = 0; channel < store.channels(); ++channel)
            QVERIFY2(isSame(store.range(channel, begin, end), history.range(channel, begin, end)),
                     qPrintable(QStringLiteral("channel %1, rows %2 ... %3 of %4")
                                    .arg(channel)
                                    .arg(begin)
                                    .arg(end)
                                    .arg(store.endRow())));
        QCOMPARE(store.nextBeginAnew(begin, end), history.nextBeginAnew(begin, end));
    }
    void compareRandomRange()
    {
        const Row begin = store.firstRow() + below(store.endRow() - store.firstRow() + 1);
        compareRange(begin, begin + below(store.endRow() - begin + 1));
    }
    void compareRandomTime()
    {
        const Row kept = store.endRow() - store.firstRow();
        const Time time = store.time(store.firstRow() + below(kept)) + Time(below(3)) - 1;
        const Row expected = history.rowAt(time, store.firstRow());
        QCOMPARE(store.rowAt(time), expected);
        const Row behind = history.rowAt(time + 1, store.firstRow());
        QCOMPARE(store.newestRow(), store.isEmpty() ? std::nullopt : std::make_optional(store.endRow() - 1));
        QCOMPARE(store.rowUpTo(time), behind > store.firstRow() ? std::make_optional(behind - 1) : std::nullopt);
        QCOMPARE(store.rowAt(time, store.firstRow() + below(kept + 1)), expected);
    }

    SignalStore store;
    History history;

private:
    std::minstd_rand m_random;
    std::vector<float> m_values;
    Time m_time = -20'000;
    bool m_interrupted = false;
    int m_nanRows = 0;
};

/// Rows 1 ns apart from 0 on, with one channel.
void appendValues(SignalStore *store, const std::vector<float> &values)
{
    for (const float value : values)
        QVERIFY(store->append(Time(store->endRow()), &value));
}

}  // namespace

class tst_SignalStore : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void storeMatchesAReferenceStore_data();
    void storeMatchesAReferenceStore();
    void aSpikeIsSeenInEachRangeThatHasIt();
    void storeKeepsAtLeastItsCapacity_data();
    void storeKeepsAtLeastItsCapacity();
    void emptyStoreHasNoRows();
    void storeWithoutChannelsKeepsTimes();
    void timesThatDoNotRiseAreRefused();
    void refusedRowKeepsTheInterruptionForTheNextOne();
    void rangeOfOnlyNanIsEmpty();
    void infinityIsAValue();
    void clearRemovesRowsAndContinuesTheirNumbers();
    void binsIgnoreClearedRows();
    void timesFarApartAndBelowZeroAreFound();
    void aValueHoldsUntilTheNextRow();
    void aValueDoesNotHoldAcrossAnInterruption();
    void newestValueHoldsUntilTheStaleLimit();
    void memoryIsAllocatedAtConstruction();
    void fourHundredSignalsForTenMinutesFit();
    void reportedMemoryEqualsTheAllocatedMemory();
};

void tst_SignalStore::storeMatchesAReferenceStore_data()
{
    QTest::addColumn<int>("capacity");
    for (const int capacity : {16, 17, 31, 32, 255, 256, 257, 300, 1000, 4096, 4097, 5000})
        QTest::addRow("capacity %d", capacity) << capacity;
}

void tst_SignalStore::storeMatchesAReferenceStore()
{
    QFETCH(int, capacity);
    Trial trial(2, capacity, unsigned(capacity));
    for (int appended = 0; appended < 10 * capacity + 100; ++appended) {
        trial.append();
        if (appended % (1 + capacity / 100) == 0)
            trial.compareRandomRange();
        if (appended % (1 + capacity / 20) == 0) {
            trial.compareRandomTime();
            trial.compareRange(trial.store.firstRow(), trial.store.endRow());
        }
        if (appended % (1 + capacity / 2) == 0)
            trial.compareRows();
        if (QTest::currentTestFailed())
            return;
    }
}

void tst_SignalStore::aSpikeIsSeenInEachRangeThatHasIt()
{
    constexpr Row count = 700;
    for (Row spike = 0; spike < count; spike += 7) {
        SignalStore store(1, int(count));
        std::vector<float> values(count, 0.0F);
        values[spike] = 5.0F;
        appendValues(&store, values);
        for (Row begin = 0; begin < count; begin += 13) {
            for (Row end = begin + 1; end <= count; end += 11)
                QCOMPARE(store.range(0, begin, end).maximum, begin <= spike && spike < end ? 5.0F : 0.0F);
        }
    }
}

void tst_SignalStore::storeKeepsAtLeastItsCapacity_data()
{
    QTest::addColumn<int>("capacity");
    for (const int capacity : {16, 17, 255, 256, 257})
        QTest::addRow("capacity %d", capacity) << capacity;
}

void tst_SignalStore::storeKeepsAtLeastItsCapacity()
{
    QFETCH(int, capacity);
    SignalStore store(1, capacity);
    QCOMPARE(store.capacity(), capacity);
    for (int i = 0; i < 5 * capacity; ++i) {
        appendValues(&store, {float(i)});
        const Row kept = store.endRow() - store.firstRow();
        QVERIFY(kept >= Row(std::min(i + 1, capacity)));
        QVERIFY(kept <= Row(std::max(capacity, 32)) + 31);
        QCOMPARE(store.value(0, store.firstRow()), float(store.firstRow()));
        QCOMPARE(store.range(0, store.firstRow(), store.endRow()).minimum, float(store.firstRow()));
    }
}

void tst_SignalStore::emptyStoreHasNoRows()
{
    const SignalStore store(3, 16);
    QVERIFY(store.isEmpty());
    QCOMPARE(store.firstRow(), Row(0));
    QCOMPARE(store.endRow(), Row(0));
    QCOMPARE(store.rowAt(0), Row(0));
    QCOMPARE(store.rowAt(0, 0), Row(0));
    QVERIFY(store.range(0, 0, 0).isEmpty());
    QCOMPARE(store.nextBeginAnew(0, 0), Row(0));
}

void tst_SignalStore::storeWithoutChannelsKeepsTimes()
{
    SignalStore store(0, 16);
    for (Time time = 0; time < 40; ++time)
        QVERIFY(store.append(10 * time, nullptr));
    QCOMPARE(store.time(store.endRow() - 1), Time(390));
    QCOMPARE(store.rowAt(381), Row(39));
}

void tst_SignalStore::timesThatDoNotRiseAreRefused()
{
    SignalStore store(1, 16);
    const float value = 1.0F;
    QVERIFY(store.append(-5, &value));
    QVERIFY(!store.append(-5, &value));
    QVERIFY(!store.append(-6, &value));
    QCOMPARE(store.endRow(), Row(1));
    QVERIFY(store.append(-4, &value));
}

void tst_SignalStore::refusedRowKeepsTheInterruptionForTheNextOne()
{
    SignalStore store(1, 16);
    appendValues(&store, {1.0F, 2.0F});
    store.interrupt();
    const float value = 3.0F;
    QVERIFY(!store.append(0, &value));
    appendValues(&store, {3.0F, 4.0F});
    QVERIFY(!store.beginsAnew(1));
    QVERIFY(store.beginsAnew(2));
    QVERIFY(!store.beginsAnew(3));
}

void tst_SignalStore::rangeOfOnlyNanIsEmpty()
{
    SignalStore store(1, 1000);
    appendValues(&store, std::vector<float>(600, noValue));
    const SignalStore::Range range = store.range(0, 0, 600);
    QVERIFY(range.isEmpty());
    QVERIFY(std::isnan(range.minimum) && std::isnan(range.maximum));
}

void tst_SignalStore::infinityIsAValue()
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SignalStore store(1, 100);
    std::vector<float> values(64, infinity);
    appendValues(&store, values);
    QVERIFY(isSame(store.range(0, 0, 64), {infinity, infinity}));
    std::fill(values.begin(), values.end(), -infinity);
    appendValues(&store, values);
    QVERIFY(isSame(store.range(0, 64, 128), {-infinity, -infinity}));
    QVERIFY(isSame(store.range(0, 60, 70), {-infinity, infinity}));
}

void tst_SignalStore::clearRemovesRowsAndContinuesTheirNumbers()
{
    SignalStore store(1, 16);
    appendValues(&store, std::vector<float>(100, 1.0F));
    store.clear();
    QVERIFY(store.isEmpty());
    QCOMPARE(store.endRow(), Row(100));
    const float value = 2.0F;
    QVERIFY(store.append(-1000, &value));
    QCOMPARE(store.firstRow(), Row(100));
    QCOMPARE(store.rowAt(-2000), Row(100));
}

void tst_SignalStore::binsIgnoreClearedRows()
{
    SignalStore store(1, 512);
    appendValues(&store, std::vector<float>(200, 9.0F));
    store.clear();
    appendValues(&store, std::vector<float>(200, 1.0F));
    QVERIFY(isSame(store.range(0, 200, 400), {1.0F, 1.0F}));
}

void tst_SignalStore::timesFarApartAndBelowZeroAreFound()
{
    SignalStore store(1, 16);
    const float value = 0.0F;
    constexpr Time farAway = Time(1) << 62;
    for (const Time time : {-farAway, Time(-1), Time(0), farAway})
        QVERIFY(store.append(time, &value));
    QCOMPARE(store.rowAt(-farAway), Row(0));
    QCOMPARE(store.rowAt(-farAway + 1), Row(1));
    QCOMPARE(store.rowAt(0), Row(2));
    QCOMPARE(store.rowAt(1, 0), Row(3));
    QCOMPARE(store.rowAt(farAway + 1, 2), Row(4));
}

void tst_SignalStore::aValueHoldsUntilTheNextRow()
{
    SignalStore store(0, 16);
    QVERIFY(!store.rowHoldingAt(0));
    for (const Time time : {100, 110, 5000, 5010})
        QVERIFY(store.append(time, nullptr));
    QVERIFY(!store.rowHoldingAt(99));
    QCOMPARE(store.rowHoldingAt(100).value(), Row(0));
    QCOMPARE(store.rowHoldingAt(109).value(), Row(0));
    QCOMPARE(store.rowHoldingAt(4999).value(), Row(1));
    QCOMPARE(store.rowHoldingAt(5000).value(), Row(2));
}

void tst_SignalStore::aValueDoesNotHoldAcrossAnInterruption()
{
    SignalStore store(0, 16);
    for (const Time time : {100, 110}) {
        QVERIFY(store.append(time, nullptr));
    }
    store.interrupt();
    QVERIFY(store.append(200, nullptr));
    store.interrupt();
    QVERIFY(store.append(300, nullptr));
    QCOMPARE(store.rowHoldingAt(119).value(), Row(1));
    QVERIFY(!store.rowHoldingAt(120));
    QVERIFY(!store.rowHoldingAt(199));
    QCOMPARE(store.rowHoldingAt(200).value(), Row(2));  // a row alone has no period
    QVERIFY(!store.rowHoldingAt(201));
}

void tst_SignalStore::newestValueHoldsUntilTheStaleLimit()
{
    constexpr Time s = 1'000'000'000;
    SignalStore store(0, 16);
    QVERIFY(store.append(s, nullptr));
    QCOMPARE(store.rowHoldingAt(s + s / 2).value(), Row(0));
    QVERIFY(!store.rowHoldingAt(s + s / 2 + 1));
    QVERIFY(store.append(2 * s, nullptr));
    QCOMPARE(store.rowHoldingAt(5 * s).value(), Row(1));
    QVERIFY(!store.rowHoldingAt(5 * s + 1));
    QVERIFY(!store.rowHoldingAt(std::numeric_limits<Time>::max() / 2));
}

void tst_SignalStore::memoryIsAllocatedAtConstruction()
{
    if (!ThreadCosts::areCounted())
        QSKIP("allocations are not counted under a sanitizer");
    SignalStore store(8, 5000);
    const std::vector<float> values(8, 1.0F);
    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (Time time = 0; time < 20'000; ++time)
        store.append(time, values.data());
    store.interrupt();
    store.clear();
    const ThreadCosts costs = ThreadCosts::ofThisThread() - before;
    QCOMPARE(store.endRow(), Row(20'000));
    QCOMPARE(costs.allocations, std::uint64_t(0));
}

void tst_SignalStore::fourHundredSignalsForTenMinutesFit()
{
    constexpr int channels = 420;
    constexpr int rows = 60'000;
    const SignalStore store(channels, rows);
    QVERIFY2(double(store.memory()) <= 5.0 * channels * rows, qPrintable(QString::number(store.memory())));
    QVERIFY(double(store.memory()) <= 150e6);
}

void tst_SignalStore::reportedMemoryEqualsTheAllocatedMemory()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the heap of a sanitizer does not tell");
    const auto used = [] {
        const struct mallinfo2 heap = ::mallinfo2();
        return double(heap.uordblks) + double(heap.hblkhd);
    };
    const double before = used();
    const SignalStore store(50, 60'000);
    const double taken = used() - before;
    QVERIFY2(std::abs(taken - double(store.memory())) < 0.01 * taken, qPrintable(QString::number(taken)));
}

QTEST_APPLESS_MAIN(tst_SignalStore)
#include "tst_SignalStore.moc"

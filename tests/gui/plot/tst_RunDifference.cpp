// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/RunDifference.h"

#include <QtTest/QtTest>

#include <cmath>
#include <limits>

using namespace qplc;

class tst_RunDifference : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void withTheSamePeriodItIsExact();
    void betweenRowsARunIsInterpolated();
    void steppedRunsHoldTheirValues();
    void acrossInterruptionsThereIsNone();
    void itGoesOnWithBothRuns();
    void onlyTheNewestRowsAreKept();
};

namespace {

constexpr RunDifference::Time always = std::numeric_limits<RunDifference::Time>::max();
constexpr RunDifference::Time ever = std::numeric_limits<RunDifference::Time>::min();

void append(SignalStore *store, RunDifference::Time period, std::initializer_list<float> values)
{
    for (const float value : values)
        store->append(store->isEmpty() ? 0 : store->newestTime() + period, &value);
}

std::vector<float> valuesOf(const SignalStore &store)
{
    std::vector<float> values;
    for (SignalStore::Row row = store.firstRow(); row < store.endRow(); ++row)
        values.push_back(store.value(0, row));
    return values;
}

}  // namespace

void tst_RunDifference::withTheSamePeriodItIsExact()
{
    SignalStore store(1, 64);
    append(&store, 10, {1.0F, 2.0F, 3.0F, 10.1F, 20.2F, 30.3F});
    // The second three rows over the first ones, and the other way round.
    RunDifference later({&store, 0}, {&store, 0, -30, 30, always}, false, 64);
    QVERIFY(later.advance(100));
    QCOMPARE(valuesOf(*later.store()), (std::vector<float>{10.1F - 1.0F, 20.2F - 2.0F, 30.3F - 3.0F}));
    QCOMPARE(later.store()->time(0), 0);
    RunDifference earlier({&store, 0}, {&store, 0, 30, 0, 30}, false, 64);
    QVERIFY(earlier.advance(100));
    QCOMPARE(valuesOf(*earlier.store()), (std::vector<float>{1.0F - 10.1F, 2.0F - 20.2F, 3.0F - 30.3F}));
    QCOMPARE(earlier.store()->time(0), 30);
}

void tst_RunDifference::betweenRowsARunIsInterpolated()
{
    SignalStore reference(1, 64);
    append(&reference, 10, {0.0F, 0.0F, 0.0F, 0.0F});
    SignalStore run(1, 64);
    append(&run, 20, {0.0F, 8.0F});
    RunDifference difference({&reference, 0}, {&run, 0, 5, ever, always}, false, 64);
    QVERIFY(difference.advance(100));
    const std::vector<float> values = valuesOf(*difference.store());
    QCOMPARE(values.size(), std::size_t(3));
    QVERIFY(std::isnan(values[0]));  // before the run
    QCOMPARE(values[1], 2.0F);       // at 5 of 20
    QCOMPARE(values[2], 6.0F);
}

void tst_RunDifference::steppedRunsHoldTheirValues()
{
    SignalStore reference(1, 64);
    append(&reference, 10, {0.0F, 0.0F, 0.0F});
    SignalStore run(1, 64);
    append(&run, 20, {1.0F, 8.0F});
    RunDifference difference({&reference, 0}, {&run, 0, 0, ever, always}, true, 64);
    QVERIFY(difference.advance(100));
    QCOMPARE(valuesOf(*difference.store()), (std::vector<float>{1.0F, 1.0F, 8.0F}));
}

void tst_RunDifference::acrossInterruptionsThereIsNone()
{
    SignalStore reference(1, 64);
    append(&reference, 10, {0.0F, 0.0F, 0.0F});
    SignalStore run(1, 64);
    append(&run, 20, {1.0F});
    run.interrupt();
    append(&run, 20, {8.0F});
    RunDifference difference({&reference, 0}, {&run, 0, 0, ever, always}, false, 64);
    QVERIFY(difference.advance(100));
    const std::vector<float> values = valuesOf(*difference.store());
    QCOMPARE(values.size(), std::size_t(3));
    QVERIFY(std::isnan(values[1]));
    QCOMPARE(values[2], 8.0F);
}

void tst_RunDifference::itGoesOnWithBothRuns()
{
    SignalStore reference(1, 64);
    SignalStore run(1, 64);
    append(&reference, 10, {1.0F, 1.0F, 1.0F, 1.0F});
    append(&run, 10, {5.0F, 6.0F});
    RunDifference difference({&reference, 0}, {&run, 0, 0, ever, always}, false, 64);
    QVERIFY(!difference.advance(1));
    QVERIFY(difference.advance(100));
    QCOMPARE(valuesOf(*difference.store()), (std::vector<float>{4.0F, 5.0F}));
    append(&run, 10, {7.0F, 8.0F, 9.0F});
    QVERIFY(difference.advance(100));
    QCOMPARE(valuesOf(*difference.store()), (std::vector<float>{4.0F, 5.0F, 6.0F, 7.0F}));
    append(&reference, 10, {1.0F});
    QVERIFY(difference.advance(100));
    QCOMPARE(difference.store()->endRow(), SignalStore::Row(5));
}

void tst_RunDifference::onlyTheNewestRowsAreKept()
{
    SignalStore store(1, 4096);
    for (int i = 0; i < 2000; ++i)
        append(&store, 10, {float(i)});
    RunDifference difference({&store, 0}, {&store, 0, 0, ever, always}, false, 1000);
    QVERIFY(difference.isCut());
    QVERIFY(difference.advance(10'000));
    QCOMPARE(difference.store()->endRow(), SignalStore::Row(1000));
    QCOMPARE(difference.store()->time(0), 10'000);
    QVERIFY(!RunDifference({&store, 0}, {&store, 0, 0, ever, always}, false, 2000).isCut());
}

QTEST_MAIN(tst_RunDifference)
#include "tst_RunDifference.moc"

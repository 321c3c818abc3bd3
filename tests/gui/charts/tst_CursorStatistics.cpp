// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/CursorStatistics.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;
using Time = SignalStore::Time;

namespace {

constexpr Time s = 1'000'000'000;
constexpr int all = 1'000'000;

void append(SignalStore *store, Time time, float value)
{
    QVERIFY(store->append(time, &value));
}

CursorStatistics::Result between(const SignalStore &store, Time first, Time second,
                                 CursorStatistics::Scaling scaling = {})
{
    CursorStatistics statistics;
    statistics.set(&store, 0, scaling, first, second);
    statistics.advance(all);
    return statistics.result();
}

}  // namespace

class tst_CursorStatistics : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init();
    void rangeWithoutRowsHasNoStatistics();
    void oneRowIsItsOwnMean();
    void manyRowsHaveTheFiguresOfTheFormulas();
    void bothCursorsBelongToTheRange();
    void theOrderOfTheCursorsDoesNotMatter();
    void statisticsApplyGainAndOffset();
    void nanCountsAsNothingAndBreaksTheIntegral();
    void theIntegralDoesNotGoOverGaps();
    void stepsHoldUntilTheNextValue();
    void largeOffsetsKeepTheirSmallDeviation();
    void eachStepProcessesABoundedNumberOfRows();
    void newRowsAreAddedWithoutBeginningAnew();
    void overwrittenRowsAreSkipped();
    void changedRangeRestartsTheStatistics();
    void valueAtATimeIsThatOfThePrecedingRow();
    void timesInGapsAndAfterTheEndHaveNoValue();

private:
    std::unique_ptr<SignalStore> m_store;
};

void tst_CursorStatistics::init()
{
    m_store = std::make_unique<SignalStore>(1, 4096);
}

void tst_CursorStatistics::rangeWithoutRowsHasNoStatistics()
{
    QCOMPARE(between(*m_store, 0, 10 * s).count, std::int64_t(0));
    append(m_store.get(), 5 * s, 1.0F);
    const CursorStatistics::Result result = between(*m_store, 6 * s, 10 * s);
    QCOMPARE(result.count, std::int64_t(0));
    QVERIFY(std::isnan(result.mean) && std::isnan(result.integral) && std::isnan(result.minimum));
    CursorStatistics none;
    none.set(nullptr, 0, {}, 0, s);
    QVERIFY(none.advance(all));
}

void tst_CursorStatistics::oneRowIsItsOwnMean()
{
    append(m_store.get(), 5 * s, -3.0F);
    const CursorStatistics::Result result = between(*m_store, 0, 10 * s);
    QCOMPARE(result.count, std::int64_t(1));
    QCOMPARE(result.mean, -3.0);
    QCOMPARE(result.rms, 3.0);
    QCOMPARE(result.sigma, 0.0);
    QCOMPARE(result.integral, 0.0);
}

void tst_CursorStatistics::manyRowsHaveTheFiguresOfTheFormulas()
{
    const float values[] = {1.0F, 2.0F, 4.0F, 9.0F};
    for (int i = 0; i < 4; ++i)
        append(m_store.get(), (i + 1) * s, values[i]);
    const CursorStatistics::Result result = between(*m_store, 0, 10 * s);
    QCOMPARE(result.count, std::int64_t(4));
    QCOMPARE(result.minimum, 1.0);
    QCOMPARE(result.maximum, 9.0);
    QCOMPARE(result.mean, 4.0);
    QCOMPARE(result.rms, std::sqrt((1.0 + 4.0 + 16.0 + 81.0) / 4.0));
    QCOMPARE(result.sigma, std::sqrt((9.0 + 4.0 + 0.0 + 25.0) / 4.0));
    QCOMPARE(result.integral, 1.5 + 3.0 + 6.5);
}

void tst_CursorStatistics::bothCursorsBelongToTheRange()
{
    for (int i = 1; i <= 5; ++i)
        append(m_store.get(), i * s, float(i));
    QCOMPARE(between(*m_store, 2 * s, 4 * s).count, std::int64_t(3));
    QCOMPARE(between(*m_store, 2 * s + 1, 4 * s - 1).count, std::int64_t(1));
    QCOMPARE(between(*m_store, 3 * s, 3 * s).count, std::int64_t(1));
}

void tst_CursorStatistics::theOrderOfTheCursorsDoesNotMatter()
{
    for (int i = 1; i <= 5; ++i)
        append(m_store.get(), i * s, float(i));
    QCOMPARE(between(*m_store, 4 * s, 2 * s).integral, between(*m_store, 2 * s, 4 * s).integral);
    QCOMPARE(between(*m_store, 4 * s, 2 * s).integral, 6.0);
}

void tst_CursorStatistics::statisticsApplyGainAndOffset()
{
    append(m_store.get(), 1 * s, 1.0F);
    append(m_store.get(), 2 * s, 3.0F);
    const CursorStatistics::Result result = between(*m_store, 0, 9 * s, {-2.0, 10.0, false});
    QCOMPARE(result.minimum, 4.0);
    QCOMPARE(result.maximum, 8.0);
    QCOMPARE(result.mean, 6.0);
    QCOMPARE(result.integral, 6.0);
}

void tst_CursorStatistics::nanCountsAsNothingAndBreaksTheIntegral()
{
    append(m_store.get(), 1 * s, 2.0F);
    append(m_store.get(), 2 * s, NAN);
    append(m_store.get(), 3 * s, 4.0F);
    append(m_store.get(), 4 * s, 4.0F);
    const CursorStatistics::Result result = between(*m_store, 0, 9 * s);
    QCOMPARE(result.count, std::int64_t(3));
    QCOMPARE(result.mean, 10.0 / 3.0);
    QCOMPARE(result.integral, 4.0);
}

void tst_CursorStatistics::theIntegralDoesNotGoOverGaps()
{
    append(m_store.get(), 1 * s, 1.0F);
    append(m_store.get(), 2 * s, 1.0F);
    m_store->interrupt();
    append(m_store.get(), 100 * s, 1.0F);
    append(m_store.get(), 101 * s, 1.0F);
    QCOMPARE(between(*m_store, 0, 200 * s).integral, 2.0);
}

void tst_CursorStatistics::stepsHoldUntilTheNextValue()
{
    append(m_store.get(), 1 * s, 0.0F);
    append(m_store.get(), 2 * s, 1.0F);
    append(m_store.get(), 4 * s, 0.0F);
    QCOMPARE(between(*m_store, 0, 9 * s, {1.0, 0.0, true}).integral, 2.0);
    QCOMPARE(between(*m_store, 0, 9 * s, {1.0, 0.0, false}).integral, 1.5);
}

void tst_CursorStatistics::largeOffsetsKeepTheirSmallDeviation()
{
    for (int i = 0; i < 1000; ++i)
        append(m_store.get(), (i + 1) * s, 1e6F + float(i % 2));
    const CursorStatistics::Result result = between(*m_store, 0, 9999 * s, {1.0, 1e9, false});
    QVERIFY(std::abs(result.sigma - 0.5) < 1e-9);
    QCOMPARE(result.mean, 1e9 + 1e6 + 0.5);
}

void tst_CursorStatistics::eachStepProcessesABoundedNumberOfRows()
{
    for (int i = 1; i <= 1000; ++i)
        append(m_store.get(), i * s, float(i));
    CursorStatistics statistics;
    statistics.set(m_store.get(), 0, {}, 0, 2000 * s);
    QVERIFY(!statistics.advance(300));
    QCOMPARE(statistics.result().count, std::int64_t(300));
    QCOMPARE(statistics.result().maximum, 300.0);
    statistics.set(m_store.get(), 0, {}, 0, 2000 * s);
    QVERIFY(!statistics.advance(300));
    QVERIFY(!statistics.advance(300));
    QVERIFY(statistics.advance(300));
    QCOMPARE(statistics.result().count, std::int64_t(1000));
    QCOMPARE(statistics.result().mean, 500.5);
}

void tst_CursorStatistics::newRowsAreAddedWithoutBeginningAnew()
{
    append(m_store.get(), 1 * s, 1.0F);
    CursorStatistics statistics;
    statistics.set(m_store.get(), 0, {}, 0, 10 * s);
    QVERIFY(statistics.advance(all));
    append(m_store.get(), 2 * s, 3.0F);
    append(m_store.get(), 11 * s, 100.0F);
    statistics.set(m_store.get(), 0, {}, 0, 10 * s);
    QVERIFY(!statistics.isComplete());
    QVERIFY(statistics.advance(1));
    QCOMPARE(statistics.result().count, std::int64_t(2));
    QCOMPARE(statistics.result().integral, 2.0);
}

void tst_CursorStatistics::overwrittenRowsAreSkipped()
{
    SignalStore store(1, 32);
    for (int i = 1; i <= 32; ++i)
        append(&store, i * s, 1.0F);
    CursorStatistics statistics;
    statistics.set(&store, 0, {}, 0, 100 * s);
    statistics.advance(4);
    for (int i = 33; i <= 44; ++i)
        append(&store, i * s, 1.0F);
    statistics.set(&store, 0, {}, 0, 100 * s);
    QVERIFY(statistics.advance(all));
    QCOMPARE(statistics.result().count, std::int64_t(4 + 32));
    QCOMPARE(statistics.result().integral, 3.0 + 31.0);  // none over what was not seen
}

void tst_CursorStatistics::changedRangeRestartsTheStatistics()
{
    for (int i = 1; i <= 5; ++i)
        append(m_store.get(), i * s, float(i));
    CursorStatistics statistics;
    statistics.set(m_store.get(), 0, {}, 0, 10 * s);
    statistics.advance(all);
    statistics.set(m_store.get(), 0, {}, 4 * s, 10 * s);
    statistics.advance(all);
    QCOMPARE(statistics.result().count, std::int64_t(2));
    statistics.reset();
    QCOMPARE(statistics.result().count, std::int64_t(0));
    QVERIFY(statistics.isComplete());
}

void tst_CursorStatistics::valueAtATimeIsThatOfThePrecedingRow()
{
    append(m_store.get(), 1 * s, 1.0F);
    append(m_store.get(), 2 * s, 5.0F);
    const CursorStatistics::Scaling doubled{2.0, 1.0, false};
    QVERIFY(std::isnan(CursorStatistics::valueAt(*m_store, 0, doubled, 0)));
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, doubled, 1 * s), 3.0);
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, doubled, 2 * s - 1), 3.0);
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, doubled, 2 * s), 11.0);
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, doubled, 3 * s), 11.0);
}

void tst_CursorStatistics::timesInGapsAndAfterTheEndHaveNoValue()
{
    append(m_store.get(), 1 * s, 1.0F);
    append(m_store.get(), 2 * s, 2.0F);
    m_store->interrupt();
    append(m_store.get(), 50 * s, 3.0F);
    append(m_store.get(), 51 * s, 4.0F);
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, {}, 2 * s), 2.0);
    QVERIFY(std::isnan(CursorStatistics::valueAt(*m_store, 0, {}, 20 * s)));
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, {}, 50 * s), 3.0);
    QCOMPARE(CursorStatistics::valueAt(*m_store, 0, {}, 53 * s), 4.0);
    QVERIFY(std::isnan(CursorStatistics::valueAt(*m_store, 0, {}, 60 * s)));
    QVERIFY(std::isnan(CursorStatistics::valueAt(SignalStore(1, 16), 0, {}, s)));
}

QTEST_APPLESS_MAIN(tst_CursorStatistics)
#include "tst_CursorStatistics.moc"

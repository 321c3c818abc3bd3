// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/StateRuns.h"

#include <QtTest/QtTest>

#include <limits>

using qplc::CurveShape;
using qplc::SignalStore;
using qplc::StateRuns;
using qplc::TimeColumns;

namespace {

constexpr SignalStore::Time millisecond = 1'000'000;
constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

/// The runs as "0-3:1 3-5:2", of rows that are a millisecond apart, in a view of \a columns.
QString runsOf(const std::vector<float> &values, int columns, QVector<int> *spikes = nullptr, int interruption = -1)
{
    SignalStore store(1, 4096);
    for (int i = 0; i < int(values.size()); ++i) {
        if (i == interruption)
            store.interrupt();
        store.append(i * millisecond, &values[std::size_t(i)]);
    }
    CurveShape shape;
    shape.read(store, 0, TimeColumns(0, SignalStore::Time(values.size()) * millisecond, columns));
    StateRuns runs;
    runs.read(shape);
    QStringList texts;
    for (const StateRuns::Run &run : runs.runs())
        texts << QStringLiteral("%1-%2:%3").arg(run.begin).arg(run.end).arg(double(run.value));
    if (spikes)
        *spikes = QVector<int>(runs.spikes().begin(), runs.spikes().end());
    return texts.join(QLatin1Char(' '));
}

}  // namespace

class tst_StateRuns : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void emptyStoreHasNoRuns();
    void aStateHoldsUntilTheNextOne();
    void manyRowsOfAColumnAreOneRun();
    void aStateShorterThanAColumnIsASpike();
    void changeWithinAColumnIsNotASpike();
    void gapsEndStates();
    void markedRowsStayPartOfTheRun();
};

void tst_StateRuns::emptyStoreHasNoRuns()
{
    QCOMPARE(runsOf({}, 10), QString());
}

void tst_StateRuns::aStateHoldsUntilTheNextOne()
{
    QVector<int> spikes;
    QCOMPARE(runsOf({1, 1, 2, 2, 2, 0}, 60, &spikes), QStringLiteral("0-20:1 20-50:2 50-51:0"));
    QVERIFY(spikes.isEmpty());
    QCOMPARE(runsOf({3}, 10), QStringLiteral("0-1:3"));
}

void tst_StateRuns::manyRowsOfAColumnAreOneRun()
{
    std::vector<float> values(1000, 1.0F);
    std::fill(values.begin() + 500, values.end(), 4.0F);
    QCOMPARE(runsOf(values, 10), QStringLiteral("0-5:1 5-10:4"));
}

void tst_StateRuns::aStateShorterThanAColumnIsASpike()
{
    std::vector<float> values(1000, 1.0F);
    values[555] = 7.0F;
    QVector<int> spikes;
    QCOMPARE(runsOf(values, 10, &spikes), QStringLiteral("0-10:1"));
    QCOMPARE(spikes, QVector<int>{5});
}

void tst_StateRuns::changeWithinAColumnIsNotASpike()
{
    std::vector<float> values(1000, 1.0F);
    std::fill(values.begin() + 555, values.end(), 2.0F);
    QVector<int> spikes;
    QCOMPARE(runsOf(values, 10, &spikes), QStringLiteral("0-5:1 5-10:2"));
    QVERIFY(spikes.isEmpty());
}

void tst_StateRuns::gapsEndStates()
{
    QCOMPARE(runsOf({1, 1, noValue, 1, 1}, 50), QStringLiteral("0-11:1 30-41:1"));
    QCOMPARE(runsOf({1, 1, 1, 1}, 40, nullptr, 2), QStringLiteral("0-11:1 20-31:1"));
}

void tst_StateRuns::markedRowsStayPartOfTheRun()
{
    SignalStore store(1, 100);
    const float value = 1.0F;
    for (int i = 0; i < 6; ++i) {
        store.append(i * millisecond, &value);
        if (i == 2 || i == 3)
            store.mark(0, 2);
    }
    CurveShape shape;
    shape.read(store, 0, TimeColumns(0, 6 * millisecond, 60));
    StateRuns runs;
    runs.read(shape);
    QCOMPARE(int(runs.runs().size()), 1);
    QCOMPARE(runs.runs().front().begin, 0);
    QCOMPARE(runs.runs().front().end, 51);
    QCOMPARE(int(runs.markedParts().size()), 1);
    QCOMPARE(runs.markedParts().front().begin, 20);
    QCOMPARE(runs.markedParts().front().end, 40);
}

QTEST_APPLESS_MAIN(tst_StateRuns)
#include "tst_StateRuns.moc"

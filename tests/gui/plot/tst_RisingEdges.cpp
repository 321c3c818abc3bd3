// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/RisingEdges.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;
using Times = std::deque<RisingEdges::Time>;

class tst_RisingEdges : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void anEdgeIsTheFirstRowAtOrAboveTheLevel();
    void theLastOnesAreKept();
    void rowsThatComeLaterAreLookedAtOnce();
    void edgesInLongPiecesAreAllFound();
    void noneIsSeenAcrossGapsAndNothing();
    void edgesThatComeTooSoonDoNotCount();
    void edgesGoWithTheirRows();
};

namespace {

/// Row i has the time i.
void append(SignalStore *store, std::initializer_list<float> values)
{
    for (const float value : values)
        store->append(RisingEdges::Time(store->endRow()), &value);
}

}  // namespace

void tst_RisingEdges::anEdgeIsTheFirstRowAtOrAboveTheLevel()
{
    SignalStore store(1, 64);
    append(&store, {2.0F, 0.0F, 0.5F, 1.0F, 0.9F, 3.0F, 3.0F});
    RisingEdges edges(&store, 0, 1.0, 10);
    QVERIFY(edges.update());
    QCOMPARE(edges.times(), (Times{3, 5}));
}

void tst_RisingEdges::theLastOnesAreKept()
{
    SignalStore store(1, 64);
    append(&store, {0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 1.0F});
    RisingEdges edges(&store, 0, 0.5, 2);
    edges.update();
    QCOMPARE(edges.times(), (Times{3, 5}));
}

void tst_RisingEdges::rowsThatComeLaterAreLookedAtOnce()
{
    SignalStore store(1, 64);
    append(&store, {1.0F, 0.0F});
    RisingEdges edges(&store, 0, 0.5, 10);
    QVERIFY(!edges.update());
    append(&store, {1.0F});
    QVERIFY(edges.update());
    QVERIFY(!edges.update());
    QCOMPARE(edges.times(), (Times{2}));
}

/// The reference looks at each row.
void tst_RisingEdges::edgesInLongPiecesAreAllFound()
{
    SignalStore store(1, 20'000);
    Times expected;
    float before = NAN;
    for (int i = 0; i < 20'000; ++i) {
        const float value = std::sin(float(i) * 2e-3F) + (i % 3001 == 0 ? -2.0F : 0.0F);
        if (before < 0.25F && value >= 0.25F)
            expected.push_back(i);
        before = value;
        append(&store, {value});
    }
    RisingEdges edges(&store, 0, 0.25, RisingEdges::Most);
    edges.update();
    QVERIFY(expected.size() > 6);
    QCOMPARE(edges.times(), expected);
}

void tst_RisingEdges::noneIsSeenAcrossGapsAndNothing()
{
    SignalStore store(1, 64);
    append(&store, {0.0F});
    store.interrupt();
    append(&store, {1.0F, 0.0F, NAN, 1.0F, 0.0F, 1.0F});
    RisingEdges edges(&store, 0, 0.5, 10);
    edges.update();
    QCOMPARE(edges.times(), (Times{6}));
}

void tst_RisingEdges::edgesThatComeTooSoonDoNotCount()
{
    SignalStore store(1, 64);
    append(&store, {0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 1.0F});
    RisingEdges edges(&store, 0, 0.5, 10, 4);
    edges.update();
    QCOMPARE(edges.times(), (Times{1, 5}));
}

void tst_RisingEdges::edgesGoWithTheirRows()
{
    SignalStore store(1, 64);
    append(&store, {0.0F, 1.0F});
    RisingEdges edges(&store, 0, 0.5, 10);
    edges.update();
    QCOMPARE(edges.times(), (Times{1}));
    for (int i = 0; i < 200; ++i)
        append(&store, {1.0F});
    QVERIFY(edges.update());
    QCOMPARE(edges.times(), Times());
}

QTEST_MAIN(tst_RisingEdges)
#include "tst_RisingEdges.moc"

// SPDX-License-Identifier: Apache-2.0
#include "gui/store/RowMarks.h"
#include "gui/store/SignalStore.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <map>
#include <random>

using qplc::RowMarks;
using qplc::SignalStore;
using Row = RowMarks::Row;

class tst_RowMarks : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void rowsWithoutMarksCostNothing();
    void marksMatchAReferenceList();
    void ofVeryManyStretchesNoMarkIsLost();
    void theNewestStretchesOfVeryManyAreExact();
    void discardedMarksFreeTheirMemory();
    void longStretchIsStoredOnce();
    void aStoreKeepsMarksOfEachChannel();
    void aStoreForgetsMarksWithTheirRows();
};

void tst_RowMarks::rowsWithoutMarksCostNothing()
{
    const RowMarks marks;
    QVERIFY(marks.isEmpty());
    QCOMPARE(marks.memory(), std::size_t(0));
    QCOMPARE(marks.greatest(0, 1000), RowMarks::None);
}

void tst_RowMarks::marksMatchAReferenceList()
{
    std::minstd_rand random(7);
    RowMarks marks;
    std::map<Row, RowMarks::Mark> truth;
    for (Row row = 0; row < 1500; row += 1 + (random() % 8 == 0 ? random() % 40 : 0)) {
        const auto mark = RowMarks::Mark(random() % 200 == 0 ? 3 : 1);
        marks.mark(row, mark);
        truth[row] = mark;
    }
    for (int i = 0; i < 5000; ++i) {
        const Row begin = random() % 1600;
        const Row end = begin + random() % 50;
        RowMarks::Mark greatest = RowMarks::None;
        for (auto each = truth.lower_bound(begin); each != truth.end() && each->first < end; ++each)
            greatest = std::max(greatest, each->second);
        QCOMPARE(int(marks.greatest(begin, end)), int(greatest));
    }
}

void tst_RowMarks::ofVeryManyStretchesNoMarkIsLost()
{
    RowMarks marks;
    for (Row row = 0; row < 100'000; row += 2)
        marks.mark(row, row == 10 ? 2 : 1);
    for (Row row = 0; row < 100'000; row += 2)
        QVERIFY(marks.greatest(row, row + 1) >= 1);
    QCOMPARE(int(marks.greatest(10, 11)), 2);
    QVERIFY(marks.memory() <= 16 * 1024);
}

void tst_RowMarks::theNewestStretchesOfVeryManyAreExact()
{
    RowMarks marks;
    for (Row row = 0; row < 100'000; row += 2)
        marks.mark(row, 1);
    for (Row row = 100'000 - RowMarks::MostStretches / 2; row < 100'000; ++row)
        QCOMPARE(int(marks.greatest(row, row + 1)), row % 2 == 0 ? 1 : 0);
}

void tst_RowMarks::discardedMarksFreeTheirMemory()
{
    RowMarks marks;
    marks.mark(5, 1);
    marks.mark(6, 1);
    marks.mark(9, 1);
    marks.forgetBefore(6);  // in the middle of a stretch
    QCOMPARE(int(marks.greatest(6, 7)), 1);
    marks.forgetBefore(7);
    QCOMPARE(int(marks.greatest(0, 9)), 0);
    QCOMPARE(int(marks.greatest(9, 10)), 1);
    marks.forgetBefore(10);
    QVERIFY(marks.isEmpty());
}

void tst_RowMarks::longStretchIsStoredOnce()
{
    RowMarks marks;
    for (Row row = 0; row < 100'000; ++row)
        marks.mark(row, 1);
    marks.mark(200'000, 2);
    QCOMPARE(int(marks.greatest(100'000, 200'000)), 0);
    QCOMPARE(int(marks.greatest(99'999, 100'001)), 1);
    QVERIFY(marks.memory() <= 64);
}

void tst_RowMarks::aStoreKeepsMarksOfEachChannel()
{
    SignalStore store(2, 16);
    const float values[] = {1.0F, 2.0F};
    for (SignalStore::Time time = 0; time < 10; ++time) {
        store.append(time, values);
        if (time == 4)
            store.mark(1, 2);
    }
    QCOMPARE(int(store.greatestMark(0, 0, 10)), 0);
    QCOMPARE(int(store.greatestMark(1, 0, 10)), 2);
    QCOMPARE(int(store.greatestMark(1, 4, 5)), 2);
    QCOMPARE(int(store.greatestMark(1, 5, 10)), 0);
}

void tst_RowMarks::aStoreForgetsMarksWithTheirRows()
{
    SignalStore store(1, 32);
    const float value = 1.0F;
    const std::size_t before = store.memory();
    for (SignalStore::Time time = 0; time < 100'000; ++time) {
        store.append(time, &value);
        if (time % 10 == 0)
            store.mark(0, 1);
    }
    QVERIFY(store.memory() <= before + 256);  // as many as there are rows for
    store.clear();
    QCOMPARE(int(store.greatestMark(0, 0, store.endRow())), 0);
}

QTEST_GUILESS_MAIN(tst_RowMarks)
#include "tst_RowMarks.moc"

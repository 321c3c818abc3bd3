// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/CurveShape.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>
#include <limits>

using qplc::CurveShape;
using qplc::SignalStore;
using qplc::TimeColumns;
using Point = CurveShape::Point;
using Time = SignalStore::Time;

namespace {

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();
constexpr Time millisecond = 1'000'000;

/// Rows one millisecond apart from 0 on.
template<typename ValueOf>
void fill(SignalStore *store, int rows, ValueOf valueOf)
{
    for (int i = 0; i < rows; ++i) {
        const float value = valueOf(i);
        QVERIFY(store->append(i * millisecond, &value));
    }
}

CurveShape shapeOf(const SignalStore &store, Time begin, Time end, int count)
{
    CurveShape shape;
    shape.read(store, 0, TimeColumns(begin * millisecond, end * millisecond, count));
    return shape;
}

const Point *pointAt(const CurveShape &shape, int x)
{
    const auto found
        = std::find_if(shape.points().begin(), shape.points().end(), [x](const Point &point) { return point.x == x; });
    return found != shape.points().end() ? &*found : nullptr;
}

}  // namespace

class tst_CurveShape : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void emptyStoreHasNoPoints();
    void fewRowsArePoints();
    void manyRowsAreColumns();
    void singleSpikeInAMillionRowsIsKept();
    void linesLeadOutOfTheView();
    void interruptionIsAGap();
    void interruptionWithinAColumnMakesTwoPoints();
    void nanIsAGap();
    void nanWithinAColumnIsNotJoinedWhereItTouchesTheNext();
    void rowsAtTheSameColumnsStayTogetherWhileTheViewMoves();
    void rowsFarAwayAreWithinIntegers();
    void viewBesideTheRowsHasOnlyTheNearestRow();
    void overwrittenRowsAreOmitted();
};

void tst_CurveShape::emptyStoreHasNoPoints()
{
    const SignalStore store(1, 16);
    QVERIFY(shapeOf(store, 0, 100, 100).points().empty());
}

void tst_CurveShape::fewRowsArePoints()
{
    SignalStore store(1, 100);
    fill(&store, 10, [](int i) { return float(i); });
    const CurveShape shape = shapeOf(store, 0, 10, 100);
    QVERIFY(!shape.isDense());
    QCOMPARE(shape.points().size(), std::size_t(10));
    for (int i = 0; i < 10; ++i) {
        const Point &point = shape.points()[std::size_t(i)];
        QCOMPARE(point.x, 10 * i);
        QCOMPARE(point.last, float(i));
        QCOMPARE(point.isJoined, i > 0);
    }
}

void tst_CurveShape::manyRowsAreColumns()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) { return float(i); });
    const CurveShape shape = shapeOf(store, 0, 1000, 100);
    QVERIFY(shape.isDense());
    QCOMPARE(shape.points().size(), std::size_t(100));
    for (int i = 0; i < 100; ++i) {
        const Point &point = shape.points()[std::size_t(i)];
        QCOMPARE(point.x, i);
        QCOMPARE(point.first, float(10 * i));
        QCOMPARE(point.last, float(10 * i + 9));
        QCOMPARE(point.minimum, point.first);
        QCOMPARE(point.maximum, point.last);
        QCOMPARE(point.isJoined, i > 0);
    }
}

void tst_CurveShape::singleSpikeInAMillionRowsIsKept()
{
    SignalStore store(1, 1'000'000);
    fill(&store, 1'000'000, [](int i) { return i == 765'432 ? 9.0F : 0.0F; });
    const CurveShape shape = shapeOf(store, 0, 1'000'000, 640);
    const auto spikes = std::count_if(shape.points().begin(), shape.points().end(),
                                      [](const Point &point) { return point.maximum == 9.0F; });
    QCOMPARE(spikes, std::ptrdiff_t(1));
    QCOMPARE(pointAt(shape, int(765'432LL * 640 / 1'000'000))->maximum, 9.0F);
}

void tst_CurveShape::linesLeadOutOfTheView()
{
    SignalStore store(1, 100);
    fill(&store, 100, [](int i) { return float(i); });
    const CurveShape sparse = shapeOf(store, 20, 30, 100);
    QCOMPARE(sparse.points().front().x, -10);
    QCOMPARE(sparse.points().front().last, 19.0F);
    QCOMPARE(sparse.points().back().x, 100);
    QCOMPARE(sparse.points().back().last, 30.0F);
    const CurveShape dense = shapeOf(store, 20, 60, 10);
    QCOMPARE(dense.points().front().last, 19.0F);
    QCOMPARE(dense.points().back().first, 60.0F);
}

void tst_CurveShape::interruptionIsAGap()
{
    SignalStore store(1, 100);
    float value = 1.0F;
    for (const Time time : {0, 1, 2, 7, 8, 9}) {
        if (time == 7)
            store.interrupt();
        store.append(time * millisecond, &value);
    }
    const CurveShape shape = shapeOf(store, 0, 10, 100);
    QCOMPARE(shape.points().size(), std::size_t(6));
    for (const Point &point : shape.points())
        QCOMPARE(point.isJoined, point.x != 0 && point.x != 70);
}

void tst_CurveShape::interruptionWithinAColumnMakesTwoPoints()
{
    SignalStore store(1, 1000);
    fill(&store, 500, [](int) { return 1.0F; });
    store.interrupt();
    for (int i = 505; i < 1000; ++i) {
        const float value = 8.0F;
        store.append(i * millisecond, &value);
    }
    const CurveShape shape = shapeOf(store, 0, 1000, 50);
    const Point *last = pointAt(shape, 24);
    QCOMPARE(last->maximum, 1.0F);
    QCOMPARE(pointAt(shape, 25)->minimum, 8.0F);
    QVERIFY(!pointAt(shape, 25)->isJoined);
    const CurveShape coarse = shapeOf(store, 0, 1000, 5);
    QCOMPARE(coarse.points().size(), std::size_t(6));
    QCOMPARE(coarse.points()[2].maximum, 1.0F);
    QCOMPARE(coarse.points()[3].minimum, 8.0F);
    QCOMPARE(coarse.points()[3].x, coarse.points()[2].x);
    QVERIFY(!coarse.points()[3].isJoined);
}

void tst_CurveShape::nanIsAGap()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) { return i >= 300 && i < 500 ? noValue : 1.0F; });
    const CurveShape dense = shapeOf(store, 0, 1000, 100);
    QCOMPARE(dense.points().size(), std::size_t(80));
    QVERIFY(!pointAt(dense, 30) && !pointAt(dense, 49));
    QVERIFY(!pointAt(dense, 50)->isJoined);
    QVERIFY(pointAt(dense, 51)->isJoined);
    const CurveShape sparse = shapeOf(store, 290, 510, 1000);
    for (const Point &point : sparse.points()) {
        QCOMPARE(point.last, 1.0F);
        QCOMPARE(point.isJoined, &point != &sparse.points().front() && point.x / 2 != 477);
    }
}

void tst_CurveShape::nanWithinAColumnIsNotJoinedWhereItTouchesTheNext()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) { return i == 109 || i == 200 ? noValue : float(i); });
    const CurveShape shape = shapeOf(store, 0, 1000, 100);
    QCOMPARE(shape.points().size(), std::size_t(100));
    QCOMPARE(pointAt(shape, 10)->maximum, 108.0F);
    QVERIFY(!pointAt(shape, 11)->isJoined);
    QVERIFY(!pointAt(shape, 20)->isJoined);
    QCOMPARE(pointAt(shape, 20)->minimum, 201.0F);
}

void tst_CurveShape::rowsAtTheSameColumnsStayTogetherWhileTheViewMoves()
{
    SignalStore store(1, 20'000);
    fill(&store, 20'000, [](int i) { return float((i * 7919) % 1000); });
    const CurveShape still = shapeOf(store, 5000, 15'000, 613);
    for (Time shift = 1; shift < 50; ++shift) {
        const CurveShape moved = shapeOf(store, 5000 + shift, 15'000 + shift, 613);
        const int columns = still.points()[300].x
            - std::find_if(moved.points().begin(), moved.points().end(), [&](const Point &point) {
                  return point.minimum == still.points()[300].minimum && point.maximum == still.points()[300].maximum
                      && point.first == still.points()[300].first;
              })->x;
        for (int x = 10; x < 600; ++x) {
            QCOMPARE(pointAt(moved, x - columns)->maximum, pointAt(still, x)->maximum);
            QCOMPARE(pointAt(moved, x - columns)->last, pointAt(still, x)->last);
        }
    }
}

void tst_CurveShape::rowsFarAwayAreWithinIntegers()
{
    SignalStore store(1, 16);
    const float value = 1.0F;
    constexpr Time year = 31'536'000'000'000'000;
    for (const Time time : {-year, Time(5 * millisecond), year})
        store.append(time, &value);
    const CurveShape shape = shapeOf(store, 0, 10, 100);
    QCOMPARE(shape.points().size(), std::size_t(3));
    QVERIFY(shape.points().front().x < -1000);
    QCOMPARE(shape.points()[1].x, 50);
    QVERIFY(shape.points().back().x > 1000);
}

void tst_CurveShape::viewBesideTheRowsHasOnlyTheNearestRow()
{
    SignalStore store(1, 100);
    fill(&store, 100, [](int i) { return float(i); });
    QCOMPARE(shapeOf(store, 500, 600, 100).points().size(), std::size_t(1));
    QCOMPARE(shapeOf(store, -600, -500, 100).points().size(), std::size_t(1));
    CurveShape between;
    between.read(store, 0, TimeColumns(1'200'000, 1'700'000, 100));
    QCOMPARE(between.points().size(), std::size_t(2));
    QVERIFY(between.points().back().isJoined);
}

void tst_CurveShape::overwrittenRowsAreOmitted()
{
    SignalStore store(1, 256);
    fill(&store, 1000, [](int i) { return float(i); });
    const CurveShape shape = shapeOf(store, 0, 1000, 100);
    QCOMPARE(shape.points().front().first, 744.0F);
    QCOMPARE(shape.points().back().last, 999.0F);
}

QTEST_APPLESS_MAIN(tst_CurveShape)
#include "tst_CurveShape.moc"

// SPDX-License-Identifier: Apache-2.0
#include "CoordinateSearch.h"

#include "Near.h"

#include <limits>

using awe::Coordinate;
using awe::CoordinateSearch;

class tst_CoordinateSearch : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void summitIsFound_data();
    void summitIsFound();
    void rangeIsKept();
    void searchIgnoresImprovementsBelowTheThreshold();
    void flatFunctionLeavesTheStart();
    void searchNeverSelectsForbiddenPoints();
    void searchWithoutCoordinatesEvaluatesOnce();
    void searchIsRepeatable();

private:
    using Point = CoordinateSearch::Point;
    /// A hill with its summit at (3, -2), 1 high.
    static double hill(const Point &p) { return 1.0 - (p[0] - 3.0) * (p[0] - 3.0) - (p[1] + 2.0) * (p[1] + 2.0); }
    static std::vector<Coordinate> wide() { return {{-10.0, 10.0, 1.0}, {-10.0, 10.0, 1.0}}; }
};

void tst_CoordinateSearch::summitIsFound_data()
{
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::newRow("from afar") << -9.5 << 8.25;
    QTest::newRow("from beside") << 3.25 << -2.0;
    QTest::newRow("from the summit") << 3.0 << -2.0;
}

void tst_CoordinateSearch::summitIsFound()
{
    QFETCH(double, x);
    QFETCH(double, y);
    CoordinateSearch search(hill, wide());
    const Point summit = search.climb({x, y}, 10);
    COMPARE_NEAR(summit[0], 3.0, 1e-3);
    COMPARE_NEAR(summit[1], -2.0, 1e-3);
    COMPARE_NEAR(search.value(), 1.0, 1e-6);
    QCOMPARE(search.value(), hill(summit));
}

void tst_CoordinateSearch::rangeIsKept()
{
    const auto inRange
        = [](const Point &p) { return p[0] >= 0.0 && p[0] <= 1.3 ? p[0] : std::numeric_limits<double>::infinity(); };
    CoordinateSearch search(inRange, {{0.0, 1.3, 1.0}});
    QCOMPARE(search.climb({0.1}, 3), Point{1.3});
}

void tst_CoordinateSearch::searchIgnoresImprovementsBelowTheThreshold()
{
    const auto slope = [](const Point &p) { return 0.01 * p[0]; };
    CoordinateSearch patient(slope, {{0.0, 10.0, 1.0}}, 0.02);
    QCOMPARE(patient.climb({5.0}, 3), Point{5.0});
    CoordinateSearch greedy(slope, {{0.0, 10.0, 1.0}}, 0.005);
    QCOMPARE(greedy.climb({5.0}, 3), Point{10.0});
}

void tst_CoordinateSearch::flatFunctionLeavesTheStart()
{
    CoordinateSearch search([](const Point &) { return 7.0; }, wide());
    QCOMPARE(search.climb({1.0, 2.0}, 2), (Point{1.0, 2.0}));
    QCOMPARE(search.evaluations(), 1 + 2 * 4);  // the start, and up and down of both in two rounds
}

void tst_CoordinateSearch::searchNeverSelectsForbiddenPoints()
{
    const double never = -std::numeric_limits<double>::infinity();
    const auto fenced = [&](const Point &p) { return p[0] > 4.0 ? never : p[0] < 0.0 ? std::nan("") : p[0]; };
    CoordinateSearch inside(fenced, {{-10.0, 10.0, 1.0}});
    QCOMPARE(inside.climb({0.0}, 4), Point{4.0});
    CoordinateSearch outside(fenced, {{-10.0, 10.0, 1.0}});
    QCOMPARE(outside.climb({4.5}, 1), Point{3.5});  // the way in is found
}

void tst_CoordinateSearch::searchWithoutCoordinatesEvaluatesOnce()
{
    CoordinateSearch search([](const Point &) { return 1.0; }, {});
    QCOMPARE(search.climb({}, 5), Point{});
    QCOMPARE(search.evaluations(), 1);
}

void tst_CoordinateSearch::searchIsRepeatable()
{
    const auto rough = [](const Point &p) { return hill(p) + std::sin(100.0 * p[0]) * std::cos(70.0 * p[1]); };
    CoordinateSearch first(rough, wide()), second(rough, wide());
    QCOMPARE(first.climb({0.0, 0.0}, 6), second.climb({0.0, 0.0}, 6));
    QCOMPARE(first.evaluations(), second.evaluations());
}

QTEST_APPLESS_MAIN(tst_CoordinateSearch)
#include "tst_CoordinateSearch.moc"

// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/PathShape.h"

#include <QtTest/QtTest>

#include <cmath>
#include <random>

using namespace qplc;
using Points = std::vector<QPointF>;

namespace {

double distanceToSegment(QPointF p, QPointF a, QPointF b)
{
    const QPointF way = b - a;
    const double square = QPointF::dotProduct(way, way);
    const double share = square > 0.0 ? std::clamp(QPointF::dotProduct(p - a, way) / square, 0.0, 1.0) : 0.0;
    const QPointF off = p - (a + share * way);
    return std::hypot(off.x(), off.y());
}

double distanceToPath(QPointF point, const Points &path)
{
    double nearest = distanceToSegment(point, path.front(), path.front());
    for (std::size_t i = 1; i < path.size(); ++i)
        nearest = std::min(nearest, distanceToSegment(point, path[i - 1], path[i]));
    return nearest;
}

std::vector<Points> shapeOf(const Points &points)
{
    PathShape shape;
    for (const QPointF &point : points)
        shape.add(point);
    return shape.finish();
}

}  // namespace

class tst_PathShape : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void emptyPathHasNoPieces();
    void onePointIsADot();
    void aStraightLineIsTwoPoints();
    void cornersAndTurnsStay();
    void standingStillIsOnePoint();
    void gapsStay();
    void omittedPointsLieOnTheSimplifiedPath_data();
    void omittedPointsLieOnTheSimplifiedPath();
    void aCircleNeedsAsManyPointsAsItHasBends();
    void clearRemovesEarlierPoints();
};

void tst_PathShape::emptyPathHasNoPieces()
{
    PathShape shape;
    QVERIFY(shape.finish().empty());
    shape.interrupt();
    QCOMPARE(shape.pointCount(), std::size_t(0));
}

void tst_PathShape::onePointIsADot()
{
    QCOMPARE(shapeOf({{3, 4}}), (std::vector<Points>{{{3, 4}}}));
}

void tst_PathShape::aStraightLineIsTwoPoints()
{
    Points line;
    for (int i = 0; i <= 10'000; ++i)
        line.emplace_back(0.03 * i, -0.01 * i);
    QCOMPARE(shapeOf(line), (std::vector<Points>{{line.front(), line.back()}}));
}

void tst_PathShape::cornersAndTurnsStay()
{
    QCOMPARE(shapeOf({{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}}), (std::vector<Points>{{{0, 0}, {10, 0}, {10, 10}}}));
    QCOMPARE(shapeOf({{0, 0}, {10, 0}, {100, 0}, {50, 0}, {0, 0}}), (std::vector<Points>{{{0, 0}, {100, 0}, {0, 0}}}));
}

void tst_PathShape::standingStillIsOnePoint()
{
    const std::vector<Points> pieces = shapeOf(Points(1000, QPointF(7, 7)));
    QCOMPARE(pieces.size(), std::size_t(1));
    QVERIFY(pieces.front().size() <= 2);
}

void tst_PathShape::gapsStay()
{
    PathShape shape;
    shape.add({0, 0});
    shape.add({5, 0});
    shape.interrupt();
    shape.interrupt();
    shape.add({6, 0});
    QCOMPARE(shape.finish(), (std::vector<Points>{{{0, 0}, {5, 0}}, {{6, 0}}}));
}

void tst_PathShape::omittedPointsLieOnTheSimplifiedPath_data()
{
    QTest::addColumn<double>("step");
    QTest::newRow("much less than a pixel") << 0.02;
    QTest::newRow("less than a pixel") << 0.3;
    QTest::newRow("pixels") << 2.0;
    QTest::newRow("many pixels") << 60.0;
}

void tst_PathShape::omittedPointsLieOnTheSimplifiedPath()
{
    QFETCH(double, step);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int run = 0; run < 5; ++run) {
        Points walk;
        double direction = 0.0;
        QPointF at(0, 0);
        for (int i = 0; i < 2000; ++i) {
            direction += 0.3 * normal(random);
            at += step * QPointF(std::cos(direction), std::sin(direction));
            walk.push_back(at);
        }
        const std::vector<Points> pieces = shapeOf(walk);
        QCOMPARE(pieces.size(), std::size_t(1));
        QCOMPARE(pieces.front().front(), walk.front());
        QCOMPARE(pieces.front().back(), walk.back());
        for (const QPointF &point : walk)
            QVERIFY(distanceToPath(point, pieces.front()) <= std::sqrt(2.0) * PathShape::tolerance + 1e-9);
    }
}

void tst_PathShape::aCircleNeedsAsManyPointsAsItHasBends()
{
    Points circle;
    for (int i = 0; i <= 1'000'000; ++i)
        circle.emplace_back(200.0 * std::cos(i * 2e-5 * M_PI), 200.0 * std::sin(i * 2e-5 * M_PI));
    const std::size_t points = shapeOf(circle).front().size();  // ten turns
    QVERIFY2(points > 10 * 20 && points < 10 * 100, qPrintable(QString::number(points)));
}

void tst_PathShape::clearRemovesEarlierPoints()
{
    PathShape shape;
    shape.add({0, 0});
    shape.add({9, 9});
    shape.clear();
    shape.add({1, 1});
    QCOMPARE(shape.finish(), (std::vector<Points>{{{1, 1}}}));
}

QTEST_APPLESS_MAIN(tst_PathShape)
#include "tst_PathShape.moc"

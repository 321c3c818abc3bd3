// SPDX-License-Identifier: Apache-2.0
#include "kite/FlightTrail.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace awe;
using Samples = FlightTrail::Samples;

namespace {

/// Values factor * 0, factor * 1, ... of the times 0, 1, ...
Samples line(int count, double factor)
{
    Samples samples;
    for (int i = 0; i < count; ++i)
        samples.append({i, factor * i, factor * i, factor * i, QPlcQuality::Good, i > 0});
    return samples;
}

}  // namespace

class tst_FlightTrail : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void pathIsEmptyWithoutHistory();
    void aPathIsMadeOfItsCoordinates();
    void aPathWithoutColorHasNoValues();
    void interruptedHistoryInterruptsThePath();
    void aTimeWithoutAPlaceInterruptsThePath_data();
    void aTimeWithoutAPlaceInterruptsThePath();
    void readingAgainReplacesThePath();
    void theRangeIsThatOfTheValues();
};

void tst_FlightTrail::pathIsEmptyWithoutHistory()
{
    FlightTrail trail;
    trail.read({}, {}, {}, {});
    QVERIFY(trail.points().empty());
    QVERIFY(trail.valueRange().isEmpty());
    trail.read({}, line(3, 1), line(3, 1), {});
    QVERIFY(trail.points().empty());
}

void tst_FlightTrail::aPathIsMadeOfItsCoordinates()
{
    FlightTrail trail;
    trail.read(line(4, 1), line(4, 2), line(4, 3), line(4, 10));
    QCOMPARE(trail.points().size(), std::size_t(4));
    QCOMPARE(trail.points().back().position, QVector3D(3, 6, 9));
    QCOMPARE(trail.points().back().value, 30.0f);
    QVERIFY(!trail.points().front().isJoined);
    QVERIFY(trail.points().back().isJoined);
}

void tst_FlightTrail::aPathWithoutColorHasNoValues()
{
    FlightTrail trail;
    trail.read(line(4, 1), line(4, 2), line(4, 3), line(2, 10));
    QCOMPARE(trail.points()[1].value, 10.0f);
    QVERIFY(std::isnan(trail.points()[2].value));
    QVERIFY(trail.points()[2].isJoined);
}

void tst_FlightTrail::interruptedHistoryInterruptsThePath()
{
    Samples x = line(6, 1);
    x[3].isJoined = false;
    FlightTrail trail;
    trail.read(x, line(6, 1), line(6, 1), {});
    QCOMPARE(trail.points().size(), std::size_t(6));
    QVERIFY(trail.points()[2].isJoined);
    QVERIFY(!trail.points()[3].isJoined);
    QVERIFY(trail.points()[4].isJoined);
}

void tst_FlightTrail::aTimeWithoutAPlaceInterruptsThePath_data()
{
    QTest::addColumn<int>("coordinate");
    QTest::addColumn<bool>("isStandIn");
    for (int coordinate = 0; coordinate < 3; ++coordinate) {
        QTest::addRow("no number in coordinate %d", coordinate) << coordinate << false;
        QTest::addRow("the writer of coordinate %d is lost", coordinate) << coordinate << true;
    }
}

void tst_FlightTrail::aTimeWithoutAPlaceInterruptsThePath()
{
    QFETCH(int, coordinate);
    QFETCH(bool, isStandIn);
    Samples all[] = {line(5, 1), line(5, 2), line(5, 3)};
    if (isStandIn)
        all[coordinate][2].quality = QPlcQuality::Safe;
    else
        all[coordinate].removeAt(2);
    FlightTrail trail;
    trail.read(all[0], all[1], all[2], line(5, 1));
    QCOMPARE(trail.points().size(), std::size_t(4));
    QCOMPARE(trail.points()[2].position, QVector3D(3, 6, 9));
    QCOMPARE(trail.points()[2].isJoined,
             !isStandIn && coordinate == 0);  // the past of x says itself where it is broken
    QVERIFY(trail.points()[3].isJoined);
}

void tst_FlightTrail::readingAgainReplacesThePath()
{
    FlightTrail trail;
    trail.read(line(5, 1), line(5, 1), line(5, 1), {});
    trail.read(line(2, 1), line(2, 1), line(2, 1), {});
    QCOMPARE(trail.points().size(), std::size_t(2));
    trail.clear();
    QVERIFY(trail.points().empty());
}

void tst_FlightTrail::theRangeIsThatOfTheValues()
{
    FlightTrail trail;
    trail.read(line(3, 1), line(3, 1), line(3, 1), line(3, -2));
    QCOMPARE(trail.valueRange().minimum, -4.0);
    QCOMPARE(trail.valueRange().maximum, 0.0);
}

QTEST_GUILESS_MAIN(tst_FlightTrail)
#include "tst_FlightTrail.moc"

// SPDX-License-Identifier: Apache-2.0
#include "QPlcQuality.h"
#include "gui/kite/FlightTrail.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

namespace {
constexpr SignalStore::Time ms = 1'000'000;
}

class tst_FlightTrail : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init() { m_store = std::make_unique<SignalStore>(4, 100'000); }
    void anEmptyStoreHasNoPath();
    void aPathIsTheRowsOfItsTime();
    void aPathIsInterruptedWhereTheStoreIs();
    void aRowWithoutAPlaceInterruptsThePath_data();
    void aRowWithoutAPlaceInterruptsThePath();
    void aLongPathHasFewPointsAndEndsWithTheNewestRow();
    void pointsStayWhereTheyAreWhileTimeGoesOn();
    void anInterruptionBetweenTwoPointsIsSeen();
    void theRangeIsThatOfTheValues();

private:
    void append(int rows);
    std::unique_ptr<SignalStore> m_store;
    FlightTrail m_trail;
};

void tst_FlightTrail::append(int rows)
{
    for (int i = 0; i < rows; ++i) {
        const auto n = float(m_store->endRow());
        const float values[] = {n, 2 * n, 3 * n + 1, 10 + n};
        QVERIFY(m_store->append(SignalStore::Time(n) * 10 * ms, values));
    }
}

void tst_FlightTrail::anEmptyStoreHasNoPath()
{
    m_trail.read(*m_store, 0, 3, 0, 1000 * ms);
    QVERIFY(m_trail.points().empty());
    QVERIFY(m_trail.valueRange().isEmpty());
}

void tst_FlightTrail::aPathIsTheRowsOfItsTime()
{
    append(10);
    m_trail.read(*m_store, 0, 3, 20 * ms, 50 * ms);
    QCOMPARE(m_trail.points().size(), std::size_t(4));
    QCOMPARE(m_trail.points().front().position, QVector3D(2, 4, 7));
    QCOMPARE(m_trail.points().back().position, QVector3D(5, 10, 16));
    QCOMPARE(m_trail.points().back().value, 15.0f);
    QVERIFY(!m_trail.points().front().isJoined);
    QVERIFY(m_trail.points().back().isJoined);
    m_trail.read(*m_store, 0, 3, 50 * ms, 20 * ms);
    QVERIFY(m_trail.points().empty());
}

void tst_FlightTrail::aPathIsInterruptedWhereTheStoreIs()
{
    append(3);
    m_store->interrupt();
    append(3);
    m_trail.read(*m_store, 0, -1, 0, 1000 * ms);
    QCOMPARE(m_trail.points().size(), std::size_t(6));
    QVERIFY(m_trail.points()[2].isJoined);
    QVERIFY(!m_trail.points()[3].isJoined);
    QVERIFY(m_trail.points()[4].isJoined);
    QVERIFY(std::isnan(m_trail.points()[0].value));
}

void tst_FlightTrail::aRowWithoutAPlaceInterruptsThePath_data()
{
    QTest::addColumn<QVector3D>("place");
    QTest::addColumn<int>("mark");
    QTest::newRow("no number") << QVector3D(1, NAN, 1) << 0;
    QTest::newRow("its writer is lost") << QVector3D(1, 2, 3) << int(QPlcQuality::Safe);
}

void tst_FlightTrail::aRowWithoutAPlaceInterruptsThePath()
{
    QFETCH(QVector3D, place);
    QFETCH(int, mark);
    append(2);
    const float values[] = {place.x(), place.y(), place.z(), 1};
    QVERIFY(m_store->append(20 * ms, values));
    if (mark != 0)
        m_store->mark(1, SignalStore::Mark(mark));
    append(2);
    m_trail.read(*m_store, 0, 3, 0, 1000 * ms);
    QCOMPARE(m_trail.points().size(), std::size_t(4));
    QVERIFY(!m_trail.points()[2].isJoined);
}

void tst_FlightTrail::aLongPathHasFewPointsAndEndsWithTheNewestRow()
{
    append(50'001);
    m_trail.read(*m_store, 0, 3, 0, 50'000 * 10 * ms);
    QVERIFY(m_trail.points().size() <= std::size_t(FlightTrail::mostPoints) + 1);
    QVERIFY(m_trail.points().size() > std::size_t(FlightTrail::mostPoints) / 3);
    QCOMPARE(m_trail.points().back().position.x(), 50'000.0f);
    for (std::size_t i = 1; i < m_trail.points().size(); ++i)
        QVERIFY(m_trail.points()[i].isJoined);
}

void tst_FlightTrail::pointsStayWhereTheyAreWhileTimeGoesOn()
{
    append(6000);
    m_trail.read(*m_store, 0, 3, 0, 5999 * 10 * ms);
    const std::vector<FlightTrail::Point> before = m_trail.points();
    append(1);
    m_trail.read(*m_store, 0, 3, 10 * ms, 6000 * 10 * ms);
    for (std::size_t i = 1; i + 1 < before.size(); ++i)
        QCOMPARE(m_trail.points()[i].position, before[i].position);
}

void tst_FlightTrail::anInterruptionBetweenTwoPointsIsSeen()
{
    append(3003);
    m_store->interrupt();
    append(3000);
    m_trail.read(*m_store, 0, 3, 0, 6003 * 10 * ms);
    int gaps = 0;
    for (std::size_t i = 1; i < m_trail.points().size(); ++i)
        gaps += m_trail.points()[i].isJoined ? 0 : 1;
    QCOMPARE(gaps, 1);
}

void tst_FlightTrail::theRangeIsThatOfTheValues()
{
    append(5);
    m_trail.read(*m_store, 0, 3, 10 * ms, 30 * ms);
    QCOMPARE(m_trail.valueRange().minimum, 11.0f);
    QCOMPARE(m_trail.valueRange().maximum, 13.0f);
}

QTEST_GUILESS_MAIN(tst_FlightTrail)
#include "tst_FlightTrail.moc"

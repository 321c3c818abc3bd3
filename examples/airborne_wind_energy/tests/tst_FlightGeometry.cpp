// SPDX-License-Identifier: Apache-2.0
#include "FlightGeometry.h"

#include "AngleMath.h"
#include "LowPass.h"
#include "Near.h"

using namespace awe;

class tst_FlightGeometry : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void geometryContainsThePositionOfTheWing();
    void azimuthCountsFromTheWindAndWraps();
    void speedsAreAlongTheSphere();
    void courseAndHeadingCountFromTheZenith();
    void slowWingHasItsHeadingForACourse();
    void geometryIsFiniteAtTheZenith();
    void anglesWrapToHalfATurn();
    void lowPassSettlesWithItsTimeConstant();
    void lowPassShorterThanTheStepPassesThrough();
};

void tst_FlightGeometry::geometryContainsThePositionOfTheWing()
{
    FlightMeasurements m;
    m.position = {60.0, 80.0, 100.0};
    const FlightGeometry g = FlightGeometry::from(m, 0.0);
    COMPARE_NEAR(g.distance, 100.0 * std::sqrt(2.0), 1e-12);
    COMPARE_NEAR(g.elevation, pi / 4.0, 1e-15);
    COMPARE_NEAR(g.cosElevation, std::sqrt(0.5), 1e-15);
    COMPARE_NEAR(g.azimuth, std::atan2(4.0, 3.0), 1e-15);
    COMPARE_NEAR(g.height, 100.0, 0.0);
}

void tst_FlightGeometry::azimuthCountsFromTheWindAndWraps()
{
    FlightMeasurements m;
    m.position = {-100.0, 1.0, 50.0};  // azimuth just below 180 deg
    COMPARE_NEAR(FlightGeometry::from(m, -170.0 * radiansPerDegree).azimuth * degreesPerRadian,
                 -10.0 - std::atan2(1.0, 100.0) * degreesPerRadian, 1e-12);
}

void tst_FlightGeometry::speedsAreAlongTheSphere()
{
    FlightMeasurements m;
    m.position = {100.0, 0.0, 0.0};
    m.velocity = {7.0, 2.0, 3.0};  // outwards, to larger azimuth, up
    const FlightGeometry g = FlightGeometry::from(m, 0.0);
    COMPARE_NEAR(g.zenithSpeed, 3.0, 1e-15);
    COMPARE_NEAR(g.azimuthSpeed, 2.0, 1e-15);
    COMPARE_NEAR(g.tangentialSpeed, std::sqrt(13.0), 1e-15);
    COMPARE_NEAR(g.climbSpeed, 3.0, 0.0);
}

void tst_FlightGeometry::courseAndHeadingCountFromTheZenith()
{
    FlightMeasurements m;
    m.position = {100.0, 0.0, 0.0};
    m.velocity = {0.0, 10.0, 0.0};
    m.yawAngle = -90.0;
    const FlightGeometry g = FlightGeometry::from(m, 0.0);
    COMPARE_NEAR(g.course(3.0), 90.0, 1e-12);
    COMPARE_NEAR(g.heading, 90.0, 0.0);
}

void tst_FlightGeometry::slowWingHasItsHeadingForACourse()
{
    FlightMeasurements m;
    m.position = {100.0, 0.0, 0.0};
    m.velocity = {0.0, 2.9, 0.0};
    m.yawAngle = 400.0;
    COMPARE_NEAR(FlightGeometry::from(m, 0.0).course(3.0), -40.0, 1e-12);
}

void tst_FlightGeometry::geometryIsFiniteAtTheZenith()
{
    FlightMeasurements m;
    m.position = {0.0, 0.0, 100.0};
    m.velocity = {1.0, 2.0, 3.0};
    const FlightGeometry g = FlightGeometry::from(m, 0.5);
    COMPARE_NEAR(g.elevation, pi / 2.0, 0.0);
    QVERIFY(std::isfinite(g.zenithSpeed) && std::isfinite(g.azimuthSpeed) && std::isfinite(g.azimuth));
}

void tst_FlightGeometry::anglesWrapToHalfATurn()
{
    COMPARE_NEAR(wrapDegrees(190.0), -170.0, 1e-12);
    COMPARE_NEAR(wrapDegrees(-540.5), 179.5, 1e-12);
    COMPARE_NEAR(wrapDegrees(180.0), 180.0, 0.0);
    COMPARE_NEAR(wrapRadians(3.5), 3.5 - 2.0 * pi, 1e-15);
    COMPARE_NEAR(saturate(-7.0, 5.0), -5.0, 0.0);
}

void tst_FlightGeometry::lowPassSettlesWithItsTimeConstant()
{
    LowPass filter(2.0, 0.001, 4.0);
    for (int i = 0; i < 2000; ++i)
        filter.step(10.0);
    COMPARE_NEAR(filter.value(), 10.0 - 6.0 * std::exp(-1.0), 2e-3);
}

void tst_FlightGeometry::lowPassShorterThanTheStepPassesThrough()
{
    LowPass filter(0.001, 0.01);
    COMPARE_NEAR(filter.step(3.0), 3.0, 0.0);
}

QTEST_APPLESS_MAIN(tst_FlightGeometry)
#include "tst_FlightGeometry.moc"

// SPDX-License-Identifier: Apache-2.0
#include "CourseController.h"

#include "AngleMath.h"
#include "Near.h"

using namespace awe;

class tst_CourseController : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eightHasItsSizeInMetres();
    void eightStaysAboveItsLowestHeightAndElevation();
    void wingAheadOfThePathPointAdvancesThePathPoint();
    void pathPointAdvancesAtMostOneRadian();
    void wingFarAwayIsLedStraightBack();
    void courseErrorIsCorrectedButNotWhenReversed();
    void guardForbidsADiveThatEndsTooLow();
    void guardAllowsAnyCourseWithHeight();
    void guardCountsTheSinkSpeed();
    void zenithModeTurnsTowardsTheWindDirection();
    void figureEightIsMirroredByTheMirroredWing();
    void resetGoesBackToTheMiddle();

private:
    static FlightGeometry at(double azimuthDegrees, double elevationDegrees, double distance = 150.0);
};

FlightGeometry tst_CourseController::at(double azimuthDegrees, double elevationDegrees, double distance)
{
    FlightGeometry g;
    g.distance = distance;
    g.elevation = elevationDegrees * radiansPerDegree;
    g.cosElevation = std::cos(g.elevation);
    g.azimuth = azimuthDegrees * radiansPerDegree;
    g.height = distance * std::sin(g.elevation);
    return g;
}

void tst_CourseController::eightHasItsSizeInMetres()
{
    const CourseController controller{AutopilotGains()};
    for (double distance : {100.0, 200.0}) {
        const auto middle = controller.pathPoint(0.0, distance), outer = controller.pathPoint(pi / 2.0, distance);
        COMPARE_NEAR((outer.azimuth - middle.azimuth) * distance * std::cos(middle.elevation), 27.0, 1e-9);
        const auto low = controller.pathPoint(pi / 4.0, distance), high = controller.pathPoint(-pi / 4.0, distance);
        COMPARE_NEAR((high.elevation - low.elevation) * distance, 13.0, 1e-9);
    }
}

void tst_CourseController::eightStaysAboveItsLowestHeightAndElevation()
{
    const CourseController controller{AutopilotGains()};
    const auto low = [&](double distance) { return controller.pathPoint(pi / 4.0, distance).elevation; };
    COMPARE_NEAR(std::sin(low(100.0)) * 100.0, 30.0, 1e-9);
    COMPARE_NEAR(low(400.0) * degreesPerRadian, 10.0, 1e-9);
    QVERIFY(std::isfinite(low(20.0)));  // shorter than the lowest height
}

void tst_CourseController::wingAheadOfThePathPointAdvancesThePathPoint()
{
    CourseController controller{AutopilotGains()};
    const auto middle = controller.pathPoint(0.0, 150.0);
    FlightGeometry g = at(0.0, middle.elevation * degreesPerRadian);
    controller.figureEight(g, 12.0, 90.0);
    const auto carrot = controller.pathPoint(controller.pathParameter(), 150.0);
    const double gap = std::hypot(carrot.azimuth * g.cosElevation, carrot.elevation - g.elevation) * 150.0;
    QVERIFY(controller.pathParameter() > 0.0);
    COMPARE_NEAR(gap, 11.0, 0.4);  // one path step is about 0.3 m
    const double before = controller.pathParameter();
    controller.figureEight(g, 12.0, 90.0);
    COMPARE_NEAR(controller.pathParameter(), before, 0.0);
    controller.figureEight(g, 32.0, 90.0);
    QVERIFY(controller.pathParameter() > before);  // faster flight looks farther ahead
}

void tst_CourseController::pathPointAdvancesAtMostOneRadian()
{
    AutopilotGains gains;
    gains.eightHalfWidth = 1.0;  // the whole eight lies within the look-ahead
    gains.eightHalfHeight = 0.1;
    CourseController controller(gains);
    FlightGeometry g = at(0.0, controller.pathPoint(0.0, 150.0).elevation * degreesPerRadian);
    controller.figureEight(g, 12.0, 90.0);
    QVERIFY(controller.pathParameter() <= 1.0 + 1e-9);
}

void tst_CourseController::wingFarAwayIsLedStraightBack()
{
    CourseController controller{AutopilotGains()};
    FlightGeometry g = at(40.0, 14.0);
    g.heading = -90.0;  // already on the way; slow, so the heading is the course
    const double yaw = controller.figureEight(g, 12.0, 90.0);
    COMPARE_NEAR(yaw, 90.0, 10.0);  // nose to smaller azimuth
}

void tst_CourseController::courseErrorIsCorrectedButNotWhenReversed()
{
    CourseController controller{AutopilotGains()};
    FlightGeometry g = at(0.0, 70.0);  // far above: bearing is straight down, held to what the guard allows
    const double bearing = 180.0;
    g.tangentialSpeed = 0.0;
    g.heading = 180.0;
    COMPARE_NEAR(std::abs(controller.figureEight(g, 12.0, 90.0)), 150.0, 0.0);
    g = at(-40.0, 14.0);
    g.heading = 80.0;
    const double straight = -controller.figureEight(g, 12.0, 90.0);
    g.heading = straight > 85.0 ? 70.0 : 75.0;
    const double corrected = -controller.figureEight(g, 12.0, 90.0);
    QVERIFY(corrected > straight);  // the course lags: steer more than the bearing
    g.heading = -95.0;              // looks the other way: no correction at all
    const double plain = -controller.figureEight(g, 12.0, 90.0);
    QVERIFY(plain < straight);
    QVERIFY(plain < bearing);
}

void tst_CourseController::guardForbidsADiveThatEndsTooLow()
{
    const CourseController controller{AutopilotGains()};
    FlightGeometry g = at(0.0, 0.0);
    g.height = 22.0;
    g.tangentialSpeed = 16.0;
    const double turns = 10.0 * (90.0 * radiansPerDegree) / (1.3 * 16.0);
    COMPARE_NEAR(controller.steepestCourse(g, 90.0), 90.0 + std::acos(1.0 - turns) * degreesPerRadian, 1e-12);
    g.height = 11.0;
    COMPARE_NEAR(controller.steepestCourse(g, 90.0), 50.0, 0.0);
}

void tst_CourseController::guardAllowsAnyCourseWithHeight()
{
    const CourseController controller{AutopilotGains()};
    FlightGeometry g = at(0.0, 40.0);
    QVERIFY(controller.steepestCourse(g, 90.0) >= 180.0);
}

void tst_CourseController::guardCountsTheSinkSpeed()
{
    const CourseController controller{AutopilotGains()};
    FlightGeometry g = at(0.0, 0.0);
    g.height = 22.0;
    g.tangentialSpeed = 16.0;
    const double level = controller.steepestCourse(g, 90.0);
    g.climbSpeed = -10.0;
    QVERIFY(controller.steepestCourse(g, 90.0) < level);
    g.climbSpeed = 10.0;
    COMPARE_NEAR(controller.steepestCourse(g, 90.0), level, 0.0);
}

void tst_CourseController::zenithModeTurnsTowardsTheWindDirection()
{
    const CourseController controller{AutopilotGains()};
    FlightGeometry g = at(12.0, 40.0);
    COMPARE_NEAR(controller.zenith(g), 12.0, 1e-12);  // nose to smaller azimuth
    g.azimuthSpeed = 2.0;
    COMPARE_NEAR(controller.zenith(g), 26.0, 1e-12);
    g.azimuthSpeed = -20.0;
    COMPARE_NEAR(controller.zenith(g), -50.0, 0.0);
}

void tst_CourseController::figureEightIsMirroredByTheMirroredWing()
{
    CourseController left{AutopilotGains()}, right{AutopilotGains()};
    FlightGeometry g = at(30.0, 14.0), mirrored = at(-30.0, 14.0);
    g.heading = 20.0;
    mirrored.heading = -20.0;
    // Both carrots still stand in the middle, the only point the eight has in common with its
    // mirror image.
    COMPARE_NEAR(left.figureEight(g, 12.0, 90.0), -right.figureEight(mirrored, 12.0, 90.0), 1e-12);
}

void tst_CourseController::resetGoesBackToTheMiddle()
{
    CourseController controller{AutopilotGains()};
    controller.figureEight(at(0.0, controller.pathPoint(0.0, 150.0).elevation * degreesPerRadian), 12.0, 90.0);
    QVERIFY(controller.pathParameter() > 0.0);
    controller.reset();
    QCOMPARE(controller.pathParameter(), 0.0);
}

QTEST_APPLESS_MAIN(tst_CourseController)
#include "tst_CourseController.moc"

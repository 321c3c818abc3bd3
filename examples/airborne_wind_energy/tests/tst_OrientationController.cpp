// SPDX-License-Identifier: Apache-2.0
#include "OrientationController.h"

#include "Near.h"

using namespace awe;

class tst_OrientationController : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void yawIsProportionalAndLimited();
    void yawLimitGrowsWithTheFlightSpeed();
    void yawNeverTurnsThroughTheNadir();
    void yawReferenceIsLimited();
    void pitchAngleIsProportionalAndLimited();
    void angleOfAttackIsReachedByPitching();
    void angleOfAttackStaysBetweenThePitchLimits();
    void pitchUpMayBeSlowedOrReversed();

private:
    const OrientationController m_controller{AutopilotGains()};
};

void tst_OrientationController::yawIsProportionalAndLimited()
{
    COMPARE_NEAR(m_controller.yawSpeed(10.0, 4.0, 12.0), 36.0, 1e-12);
    COMPARE_NEAR(m_controller.yawSpeed(60.0, 0.0, 12.0), 90.0, 0.0);
    COMPARE_NEAR(m_controller.yawSpeed(-60.0, 0.0, 12.0), -90.0, 0.0);
}

void tst_OrientationController::yawLimitGrowsWithTheFlightSpeed()
{
    COMPARE_NEAR(m_controller.yawSpeedLimit(5.0), 90.0, 0.0);
    COMPARE_NEAR(m_controller.yawSpeedLimit(24.0), 135.0, 1e-12);
    COMPARE_NEAR(m_controller.yawSpeedLimit(100.0), 180.0, 0.0);
}

void tst_OrientationController::yawNeverTurnsThroughTheNadir()
{
    // From 140 to -140 deg the way through 180 deg (the ground side) is 80 deg, through 0 (the
    // zenith) 280 deg.
    QVERIFY(m_controller.yawSpeed(-140.0, 140.0, 12.0) < 0.0);
    QVERIFY(m_controller.yawSpeed(140.0, -140.0, 12.0) > 0.0);
    QVERIFY(m_controller.yawSpeed(140.0, 220.0, 12.0) > 0.0);  // 220 deg is -140 deg
}

void tst_OrientationController::yawReferenceIsLimited()
{
    COMPARE_NEAR(m_controller.yawSpeed(170.0, 145.0, 12.0), 30.0, 1e-12);
}

void tst_OrientationController::pitchAngleIsProportionalAndLimited()
{
    FlightMeasurements m;
    m.pitchAngle = 4.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::PitchAngle, 9.0}, m), 20.0, 1e-12);
    m.pitchAngle = -90.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::PitchAngle, 9.0}, m), 60.0, 0.0);
}

void tst_OrientationController::angleOfAttackIsReachedByPitching()
{
    FlightMeasurements m;
    m.pitchAngle = -80.0;
    m.angleOfAttack = 3.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::AngleOfAttack, -4.0}, m), -28.0, 1e-12);
}

void tst_OrientationController::angleOfAttackStaysBetweenThePitchLimits()
{
    FlightMeasurements m;
    m.pitchAngle = -108.0;
    m.angleOfAttack = 30.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::AngleOfAttack, -20.0}, m), -8.0, 1e-12);
    m.pitchAngle = 8.0;
    m.angleOfAttack = -30.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::AngleOfAttack, 15.0}, m), 4.0, 1e-12);
}

void tst_OrientationController::pitchUpMayBeSlowedOrReversed()
{
    FlightMeasurements m;
    m.pitchAngle = -90.0;
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::PitchAngle, 9.0, 12.0}, m), 12.0, 0.0);
    COMPARE_NEAR(m_controller.pitchSpeed({PitchReference::Kind::PitchAngle, 9.0, -500.0}, m), -60.0, 0.0);
}

QTEST_APPLESS_MAIN(tst_OrientationController)
#include "tst_OrientationController.moc"

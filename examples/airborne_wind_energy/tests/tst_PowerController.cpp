// SPDX-License-Identifier: Apache-2.0
#include "PowerController.h"

#include "AngleMath.h"
#include "Near.h"

using namespace awe;
using References = PowerController::References;

/// Drives the power controller with made-up measurements: no plant.
class tst_PowerController : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void launchEndsWithSpeed();
    void launchEndsWithTime();
    void launchHoldsTheTether();
    void powerBecomesReelOutAfterFourSeconds();
    void reelOutFollowsTheSquareRootOfTheForce();
    void reelOutSpeedIsLimited();
    void tetherSpeedChangesWithTheWinchAcceleration();
    void longTetherEndsTheReelOut();
    void windSpeedIsEstimatedFromTheReelOut();
    void retractEndsWithTheNoseUpOrTime();
    void reelInIsFastWithoutForceAndStopsWithIt();
    void reelInAngleOfAttackDependsOnElevationAndClimb();
    void shortTetherEndsTheReelIn();
    void lullStartsARecovery();
    void shortLullStartsNoRecovery();
    void lullDetectionStartsAfterADelay();
    void recoveryPullsWithTheWinchUntilHighEnough();
    void recoveryStopsThePullAtAShortTether();
    void forceLimitPaysOutAndHoldsThePitchBack();
    void controllerWithoutForceLimitDoesNotLimitThePitchRate();
    void resetRestoresTheInitialState();

private:
    References run(double duration);
    void toReelOut(double force = 1600.0);
    void toReelIn();
    PowerController m_controller{AutopilotGains()};
    FlightMeasurements m_measurements;
    FlightGeometry m_geometry;
};

void tst_PowerController::init()
{
    m_controller = PowerController(AutopilotGains());
    m_measurements = FlightMeasurements();
    m_measurements.tetherLength = 150.0;
    m_measurements.angleOfAttack = 22.0;
    m_geometry = FlightGeometry();
    m_geometry.height = 40.0;
    m_geometry.tangentialSpeed = 20.0;
    m_geometry.heading = 120.0;
}

References tst_PowerController::run(double duration)
{
    References references;
    for (long i = 0; i < std::lround(duration / 0.01); ++i)
        references = m_controller.step(m_measurements, m_geometry);
    return references;
}

void tst_PowerController::toReelOut(double force)
{
    m_measurements.tetherForce = force;
    QCOMPARE(run(8.0).phase, FlightPhase::ReelOut);
}

void tst_PowerController::toReelIn()
{
    toReelOut();
    m_measurements.tetherLength = 201.0;
    QCOMPARE(run(0.01).phase, FlightPhase::Retract);
    m_geometry.heading = 0.0;
    QCOMPARE(run(0.01).phase, FlightPhase::ReelIn);
}

void tst_PowerController::launchEndsWithSpeed()
{
    m_geometry.tangentialSpeed = 7.9;
    QCOMPARE(run(0.01).phase, FlightPhase::Launch);
    m_geometry.tangentialSpeed = 8.1;
    QCOMPARE(run(0.01).phase, FlightPhase::Power);
}

void tst_PowerController::launchEndsWithTime()
{
    m_geometry.tangentialSpeed = 7.9;
    QCOMPARE(run(4.98).phase, FlightPhase::Launch);
    QCOMPARE(run(0.04).phase, FlightPhase::Power);
}

void tst_PowerController::launchHoldsTheTether()
{
    m_geometry.tangentialSpeed = 5.0;
    m_measurements.tetherForce = 2000.0;
    const References references = run(1.0);
    QCOMPARE(references.tetherSpeed, 0.0);
    QCOMPARE(references.course, PowerController::Course::Zenith);
    QCOMPARE(references.pitch.angle, 9.0);
}

void tst_PowerController::powerBecomesReelOutAfterFourSeconds()
{
    const References power = run(4.0);
    QCOMPARE(power.phase, FlightPhase::Power);
    QCOMPARE(power.course, PowerController::Course::FigureEight);
    QCOMPARE(run(0.05).phase, FlightPhase::ReelOut);
}

void tst_PowerController::reelOutFollowsTheSquareRootOfTheForce()
{
    toReelOut(1600.0);
    COMPARE_NEAR(run(1.0).tetherSpeed, 0.75 * std::sqrt(1600.0 / 421.0), 1e-9);
    COMPARE_NEAR(m_controller.filteredForce(), 1600.0, 1e-6);
}

void tst_PowerController::reelOutSpeedIsLimited()
{
    toReelOut(1e6);
    QCOMPARE(run(1.0).tetherSpeed, 10.0);
}

void tst_PowerController::tetherSpeedChangesWithTheWinchAcceleration()
{
    toReelOut(1600.0);
    m_measurements.tetherForce = 1e6;
    run(0.5);
    const double before = run(0.01).tetherSpeed;
    COMPARE_NEAR(run(0.1).tetherSpeed - before, 0.5, 1e-9);
}

void tst_PowerController::longTetherEndsTheReelOut()
{
    toReelOut(1600.0);
    m_measurements.tetherLength = 200.0;
    const References references = run(2.0);
    QCOMPARE(references.phase, FlightPhase::Retract);
    QCOMPARE(references.course, PowerController::Course::Zenith);
    COMPARE_NEAR(references.tetherSpeed, 0.3 * 0.75 * std::sqrt(1600.0 / 421.0), 1e-6);
}

void tst_PowerController::windSpeedIsEstimatedFromTheReelOut()
{
    QCOMPARE(m_controller.windSpeedEstimate(), 0.0);
    toReelOut(1600.0);
    run(20.0);
    m_measurements.tetherLength = 200.0;
    run(0.01);
    COMPARE_NEAR(m_controller.windSpeedEstimate(), 1.2 * 2.75 * std::sqrt(1600.0 / 421.0), 0.01);
}

void tst_PowerController::retractEndsWithTheNoseUpOrTime()
{
    toReelOut();
    m_measurements.tetherLength = 200.0;
    QCOMPARE(run(5.9).phase, FlightPhase::Retract);
    QCOMPARE(run(0.2).phase, FlightPhase::ReelIn);
    init();
    toReelIn();
}

void tst_PowerController::reelInIsFastWithoutForceAndStopsWithIt()
{
    toReelIn();
    const double wind = m_controller.windSpeedEstimate();
    m_measurements.tetherForce = 0.0;
    COMPARE_NEAR(run(6.0).tetherSpeed, -1.3 * wind, 1e-6);
    const double stopForce = 0.3 * 421.0 * wind * wind / 9.0;
    m_measurements.tetherForce = 0.5 * stopForce;
    COMPARE_NEAR(run(6.0).tetherSpeed, -0.65 * wind, 1e-6);
    m_measurements.tetherForce = stopForce;
    COMPARE_NEAR(run(6.0).tetherSpeed, 0.0, 1e-6);
    m_measurements.tetherForce = 5.0 * stopForce;
    COMPARE_NEAR(run(6.0).tetherSpeed, 3.0, 1e-9);
}

void tst_PowerController::reelInAngleOfAttackDependsOnElevationAndClimb()
{
    toReelIn();
    m_geometry.elevation = 26.0 * radiansPerDegree;
    m_geometry.zenithSpeed = 2.0;
    const PitchReference pitch = run(0.01).pitch;
    QCOMPARE(pitch.kind, PitchReference::Kind::AngleOfAttack);
    COMPARE_NEAR(pitch.angle, -4.0 + 0.5 * (20.0 - 26.0) - 1.7 * 2.0, 1e-9);
    m_geometry.zenithSpeed = 100.0;
    COMPARE_NEAR(run(0.01).pitch.angle, -20.0, 0.0);
    m_geometry.zenithSpeed = -100.0;
    COMPARE_NEAR(run(0.01).pitch.angle, 15.0, 0.0);
}

void tst_PowerController::shortTetherEndsTheReelIn()
{
    toReelIn();
    m_measurements.tetherLength = 100.1;
    QCOMPARE(run(1.0).phase, FlightPhase::ReelIn);
    m_measurements.tetherLength = 100.0;
    QCOMPARE(run(0.01).phase, FlightPhase::Power);
}

void tst_PowerController::lullStartsARecovery()
{
    toReelOut();
    m_measurements.angleOfAttack = 40.0;
    m_geometry.tangentialSpeed = 5.0;
    m_geometry.height = 15.0;
    QCOMPARE(run(0.58).phase, FlightPhase::ReelOut);
    const References references = run(0.05);
    QCOMPARE(references.phase, FlightPhase::Recover);
    QCOMPARE(references.pitch.kind, PitchReference::Kind::AngleOfAttack);
    QCOMPARE(references.pitch.angle, 13.0);
}

void tst_PowerController::shortLullStartsNoRecovery()
{
    toReelOut();
    for (int i = 0; i < 5; ++i) {
        m_measurements.angleOfAttack = 40.0;
        m_geometry.tangentialSpeed = 5.0;
        QCOMPARE(run(0.5).phase, FlightPhase::ReelOut);
        m_geometry.tangentialSpeed = 8.0;
        QCOMPARE(run(0.01).phase, FlightPhase::ReelOut);
    }
}

void tst_PowerController::lullDetectionStartsAfterADelay()
{
    m_measurements.angleOfAttack = 60.0;
    m_geometry.tangentialSpeed = 1.0;
    m_geometry.height = 15.0;
    QCOMPARE(run(3.0).phase, FlightPhase::Launch);
    QCOMPARE(run(0.2).phase, FlightPhase::Recover);
}

void tst_PowerController::recoveryPullsWithTheWinchUntilHighEnough()
{
    lullStartsARecovery();
    m_geometry.height = 25.0;
    COMPARE_NEAR(run(3.0).tetherSpeed, -5.0, 1e-9);
    m_geometry.height = 5.0;
    COMPARE_NEAR(run(3.0).tetherSpeed, -8.0, 1e-9);
    m_geometry.height = 28.5;
    QCOMPARE(run(0.1).phase, FlightPhase::Recover);  // the angle of attack is still too large
    m_measurements.angleOfAttack = 20.0;
    QCOMPARE(run(0.01).phase, FlightPhase::Power);
}

void tst_PowerController::recoveryStopsThePullAtAShortTether()
{
    lullStartsARecovery();
    m_measurements.tetherLength = 50.0;
    COMPARE_NEAR(run(3.0).tetherSpeed, 0.0, 1e-9);
}

void tst_PowerController::forceLimitPaysOutAndHoldsThePitchBack()
{
    AutopilotGains gains;
    gains.forceLimit = 4000.0;
    m_controller = PowerController(gains);
    toReelOut(3800.0);  // the set point: the winch neither gives way nor follows the law down
    const References atSetPoint = run(1.0);
    COMPARE_NEAR(run(1.0).tetherSpeed, atSetPoint.tetherSpeed, 1e-9);
    COMPARE_NEAR(atSetPoint.pitch.fastestUp, 0.04 * 200.0, 1e-3);
    m_measurements.tetherForce = 4200.0;
    const References above = run(1.0);
    QVERIFY(above.tetherSpeed > atSetPoint.tetherSpeed + 3.0);
    QVERIFY(above.pitch.fastestUp < 0.0);
    COMPARE_NEAR(run(10.0).tetherSpeed, 10.0, 0.0);
    m_measurements.tetherForce = 1000.0;  // far below: back to the law
    COMPARE_NEAR(run(10.0).tetherSpeed, 0.75 * std::sqrt(1000.0 / 421.0), 1e-6);
}

void tst_PowerController::controllerWithoutForceLimitDoesNotLimitThePitchRate()
{
    toReelOut(1e5);
    QVERIFY(std::isinf(run(0.1).pitch.fastestUp));
}

void tst_PowerController::resetRestoresTheInitialState()
{
    toReelIn();
    m_controller.reset();
    QCOMPARE(m_controller.phase(), FlightPhase::Launch);
    QCOMPARE(m_controller.windSpeedEstimate(), 0.0);
    QCOMPARE(m_controller.filteredForce(), 0.0);
}

QTEST_APPLESS_MAIN(tst_PowerController)
#include "tst_PowerController.moc"

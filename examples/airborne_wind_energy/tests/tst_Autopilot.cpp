// SPDX-License-Identifier: Apache-2.0
#include "Autopilot.h"

#include "Near.h"

using namespace awe;

class tst_Autopilot : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void launchesTowardsTheZenithAboveTheWind();
    void windDirectionStartsWithTheFirstMeasurement();
    void windDirectionIsFollowedSlowlyAndTheShortWayRound();
    void phaseEqualsThePhaseOfThePowerController();
    void mirroredMeasurementsMirrorTheYawInZenithMode();
    void unusableMeasurementsGiveZeroCommandsAndLeaveNoState();
    void resetRepeatsTheCommandsBitForBit();

private:
    FlightMeasurements m_measurements;
};

void tst_Autopilot::init()
{
    m_measurements = FlightMeasurements();
    m_measurements.position = {80.0, 20.0, 50.0};
    m_measurements.tetherLength = 100.0;
    m_measurements.pitchAngle = 9.0;
    m_measurements.windDirection = 0.0;
}

void tst_Autopilot::launchesTowardsTheZenithAboveTheWind()
{
    Autopilot autopilot;
    const AutopilotOutputs outputs = autopilot.step(m_measurements);
    QCOMPARE(outputs.phase, FlightPhase::Launch);
    QCOMPARE(outputs.tetherSpeed, 0.0);
    QCOMPARE(outputs.pitchSpeed, 0.0);
    COMPARE_NEAR(outputs.yawSpeed, 6.0 * std::atan2(20.0, 80.0) * 180.0 / M_PI, 1e-9);
}

void tst_Autopilot::windDirectionStartsWithTheFirstMeasurement()
{
    Autopilot autopilot;
    m_measurements.windDirection = std::atan2(20.0, 80.0) * 180.0 / M_PI;
    COMPARE_NEAR(autopilot.step(m_measurements).yawSpeed, 0.0, 1e-9);  // the wing is downwind already
}

void tst_Autopilot::windDirectionIsFollowedSlowlyAndTheShortWayRound()
{
    Autopilot autopilot;
    m_measurements.position = {-80.0, 0.0, 50.0};  // azimuth 180 deg
    m_measurements.windDirection = 175.0;
    autopilot.step(m_measurements);
    m_measurements.windDirection = -175.0;  // 10 deg farther, through 180
    for (int i = 0; i < 100; ++i)           // 1 s of 20 s
        autopilot.step(m_measurements);
    COMPARE_NEAR(autopilot.step(m_measurements).yawSpeed / 6.0, 5.0 - 10.0 * (1.0 - std::exp(-1.0 / 20.0)), 0.01);
}

void tst_Autopilot::phaseEqualsThePhaseOfThePowerController()
{
    Autopilot autopilot;
    m_measurements.velocity = {0.0, 15.0, 0.0};
    QCOMPARE(autopilot.step(m_measurements).phase, FlightPhase::Power);
    QCOMPARE(autopilot.phase(), FlightPhase::Power);
}

void tst_Autopilot::mirroredMeasurementsMirrorTheYawInZenithMode()
{
    Autopilot left, right;
    FlightMeasurements mirrored = m_measurements;
    m_measurements.velocity = {1.0, 2.0, 3.0};
    m_measurements.yawAngle = 12.0;
    mirrored.position.y() *= -1.0;
    mirrored.velocity = {1.0, -2.0, 3.0};
    mirrored.yawAngle = -12.0;
    COMPARE_NEAR(left.step(m_measurements).yawSpeed, -right.step(mirrored).yawSpeed, 1e-12);
}

void tst_Autopilot::unusableMeasurementsGiveZeroCommandsAndLeaveNoState()
{
    Autopilot autopilot, untouched;
    m_measurements.velocity = {0.0, 15.0, 0.0};
    FlightMeasurements notANumber = m_measurements;
    notANumber.angleOfAttack = std::nan("");
    for (const FlightMeasurements &unusable : {FlightMeasurements(), notANumber}) {
        const AutopilotOutputs outputs = autopilot.step(unusable);
        QVERIFY(outputs.yawSpeed == 0.0 && outputs.pitchSpeed == 0.0 && outputs.tetherSpeed == 0.0);
        QCOMPARE(outputs.phase, FlightPhase::Launch);
    }
    const AutopilotOutputs seen = autopilot.step(m_measurements), expected = untouched.step(m_measurements);
    QVERIFY(seen.yawSpeed == expected.yawSpeed && seen.phase == expected.phase);
}

void tst_Autopilot::resetRepeatsTheCommandsBitForBit()
{
    Autopilot autopilot;
    const auto fly = [&](std::vector<AutopilotOutputs> &commands) {
        autopilot.reset();
        FlightMeasurements m = m_measurements;
        for (int i = 0; i < 3000; ++i) {
            const double t = 0.01 * i;
            m.position = {100.0 * std::cos(0.3 * std::sin(t)), 100.0 * std::sin(0.3 * std::sin(t)), 40.0};
            m.velocity = {0.0, 30.0 * std::cos(t), 5.0 * std::sin(2.0 * t)};
            m.yawAngle = 90.0 * std::sin(t);
            m.tetherForce = 1500.0 + 500.0 * std::sin(3.0 * t);
            m.tetherLength = 100.0 + 4.0 * t;
            m.windDirection = 5.0 * std::sin(0.5 * t);
            commands.push_back(autopilot.step(m));
        }
    };
    std::vector<AutopilotOutputs> first, second;
    fly(first);
    fly(second);
    for (std::size_t i = 0; i < first.size(); ++i) {
        QVERIFY(first[i].yawSpeed == second[i].yawSpeed && first[i].pitchSpeed == second[i].pitchSpeed);
        QVERIFY(first[i].tetherSpeed == second[i].tetherSpeed && first[i].phase == second[i].phase);
    }
    QCOMPARE(first.back().phase, FlightPhase::ReelIn);
}

QTEST_APPLESS_MAIN(tst_Autopilot)
#include "tst_Autopilot.moc"

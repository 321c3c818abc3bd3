// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"
#include "SteeringController.h"

#include "AngleMath.h"
#include "Near.h"

using namespace awe;

class tst_SteeringController : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void wingTurnsAsFastAsWanted_data();
    void wingTurnsAsFastAsWanted();
    void commandIsLimited();
    void slowWingGetsNoLargerCommandThanAtTheSlowestSpeed();
    void kinematicWingIsNotSteered();
};

void tst_SteeringController::wingTurnsAsFastAsWanted_data()
{
    QTest::addColumn<double>("yawAngle");
    QTest::addColumn<double>("yawSpeed");
    QTest::newRow("nose to the zenith") << 0.0 << 30.0;
    QTest::newRow("nose along the horizon") << -90.0 << -20.0;
    QTest::newRow("nose down") << 150.0 << 0.0;
}

// The plant with the command of the controller turns by what was wanted.
void tst_SteeringController::wingTurnsAsFastAsWanted()
{
    QFETCH(double, yawAngle);
    QFETCH(double, yawSpeed);
    PlantOptions options;
    options.steering.kind = SteeringKind::TurnRate;
    options.steering.actuatorTime = 0.01;  // as good as at once
    options.steering.actuatorRate = 100.0;
    PlantParameters kite;
    kite.mass = 1e6;  // the course of the wing stays
    kite.gravity = 0.0;
    kite.initialState.velocity = {-4.0, 12.0, 2.0};
    kite.initialState.yawAngle = yawAngle;
    ExtendedPlant plant(kite, options);
    const SteeringController controller(AutopilotGains::steered());
    PlantInputs inputs;
    inputs.windVelocity = {5.0, 3.0, 0.0};
    double turned = 0.0;
    for (int cycle = 0; cycle < 20; ++cycle) {
        const PlantOutputs before = plant.outputs(inputs);
        const FlightMeasurements measured = ClosedLoopFlight::measured(before);
        inputs.steering = controller.steering(yawSpeed, measured, FlightGeometry::from(measured, 0.0));
        QVERIFY(std::abs(inputs.steering) < 1.0);
        plant.step(inputs);
        turned = (plant.outputs(inputs).bodyControlOrientation.z() - before.bodyControlOrientation.z()) / 0.01;
    }
    COMPARE_NEAR(turned, yawSpeed, 0.3);
}

void tst_SteeringController::commandIsLimited()
{
    FlightMeasurements measured;
    measured.position = {80.0, 0.0, 50.0};
    measured.airspeed = 20.0;
    const SteeringController controller(AutopilotGains::steered());
    const FlightGeometry geometry = FlightGeometry::from(measured, 0.0);
    QCOMPARE(controller.steering(-1e6, measured, geometry), 1.0);
    QCOMPARE(controller.steering(1e6, measured, geometry), -1.0);
}

void tst_SteeringController::slowWingGetsNoLargerCommandThanAtTheSlowestSpeed()
{
    FlightMeasurements measured;
    measured.position = {80.0, 0.0, 50.0};
    const SteeringController controller(AutopilotGains::steered());
    const FlightGeometry geometry = FlightGeometry::from(measured, 0.0);
    measured.airspeed = AutopilotGains::steered().slowestSteeringSpeed;
    const double atSlowest = controller.steering(10.0, measured, geometry);
    measured.airspeed = 0.0;
    QCOMPARE(controller.steering(10.0, measured, geometry), atSlowest);
}

void tst_SteeringController::kinematicWingIsNotSteered()
{
    FlightMeasurements measured;
    measured.position = {80.0, 0.0, 50.0};
    const SteeringController controller(AutopilotGains::safe());
    QCOMPARE(controller.steering(100.0, measured, FlightGeometry::from(measured, 0.0)), 0.0);
}

QTEST_APPLESS_MAIN(tst_SteeringController)
#include "tst_SteeringController.moc"

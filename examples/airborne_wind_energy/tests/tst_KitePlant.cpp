// SPDX-License-Identifier: Apache-2.0
#include "KitePlant.h"

#include "Near.h"

#include <cstring>

using namespace awe;
using Eigen::Vector3d;

class tst_KitePlant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void outputsBelongToStateAndInputsAndChangeNothing();
    void slackTetherPullsNothingAndGivesNoPower();
    void tautTetherPullsTowardsTheGroundStation();
    void dampingActsOnlyWhileTaut();
    void forceOfTheTetherIsNeverNegative();
    void noRelativeWindGivesGravityOnly();
    void freeFallIsExact();
    void controlAnglesAndTetherLengthAreRamps();
    void energyIsTheIntegralOfPower();
    void averagePowerSettlesWithItsTimeConstant();
    void mirroredFlightMirrorsTheTrajectory();
    void turnedWorldTurnsTheTrajectory();
    void runge_KuttaIsOfOrderFourWhereSmooth();
    void quasiSteadyFlightGivesThePublishedPower();
    void fifthOfTheDragFliesFiveTimesAsFast();
    void dynamicMaximumPowerIsNearTheQuasiSteadyOne();
    void wingAboveTheStationHasFiniteOutputs();
    void referenceModeFliesThroughTheGround();
    void crashedWingIsHeld();
    void resetRepeatsTheFlightBitForBit();
    void fullAngleRangeChangesOnlyBackwardFlow();

private:
    static PlantInputs thesisInputs(double tetherSpeed = 0.0);
};

PlantInputs tst_KitePlant::thesisInputs(double tetherSpeed)
{
    PlantInputs inputs;
    inputs.tetherSpeed = tetherSpeed;
    inputs.windVelocity = {5.0, 3.0, 0.0};
    return inputs;
}

void tst_KitePlant::outputsBelongToStateAndInputsAndChangeNothing()
{
    KitePlant plant;
    for (int i = 0; i < 100; ++i)
        plant.step(thesisInputs());
    const PlantState before = plant.state();
    const PlantOutputs still = plant.outputs(thesisInputs(0.0)), out = plant.outputs(thesisInputs(2.0));
    QCOMPARE(plant.state().position, before.position);
    QCOMPARE(still.power, 0.0);
    COMPARE_NEAR(out.power, 2.0 * out.tetherForce.norm(), 1e-9);
    QCOMPARE(out.inputs.tetherSpeed, 2.0);
    QCOMPARE(out.position, before.position);
    QCOMPARE(out.bodyControlOrientation, Vector3d(0.0, 9.0, 0.0));
    COMPARE_NEAR(out.bodyPositionOrientation.y(),
                 90.0 - std::asin(before.position.z() / before.position.norm()) * 180.0 / M_PI, 1e-12);
}

void tst_KitePlant::slackTetherPullsNothingAndGivesNoPower()
{
    PlantParameters parameters;
    parameters.initialState.tetherLength = 100.5;
    const PlantOutputs y = KitePlant(parameters).outputs(thesisInputs(-3.0));
    QCOMPARE(y.tetherForce.norm(), 0.0);
    QCOMPARE(y.power, 0.0);
}

void tst_KitePlant::tautTetherPullsTowardsTheGroundStation()
{
    PlantParameters parameters;
    parameters.initialState.tetherLength = 99.0;
    const PlantOutputs y = KitePlant(parameters).outputs(thesisInputs(2.0));
    COMPARE_NEAR((y.tetherForce + 1000.0 * y.position / 100.0).norm(), 0.0, 1e-9);
    COMPARE_NEAR(y.power, 2000.0, 1e-9);
}

void tst_KitePlant::dampingActsOnlyWhileTaut()
{
    PlantParameters parameters;
    parameters.tetherDamping = 50.0;
    parameters.initialState.velocity = 3.0 * parameters.initialState.position / 100.0;  // outwards at 3 m/s
    parameters.initialState.tetherLength = 99.0;
    COMPARE_NEAR(KitePlant(parameters).outputs(thesisInputs(1.0)).tetherForce.norm(), 1000.0 + 50.0 * (3.0 - 1.0),
                 1e-9);
    parameters.initialState.tetherLength = 101.0;
    QCOMPARE(KitePlant(parameters).outputs(thesisInputs(1.0)).tetherForce.norm(), 0.0);
}

void tst_KitePlant::forceOfTheTetherIsNeverNegative()
{
    PlantParameters parameters;
    parameters.tetherDamping = 500.0;
    parameters.initialState.tetherLength = 99.9;
    parameters.initialState.velocity = -3.0 * parameters.initialState.position / 100.0;  // inwards: damping would push
    QCOMPARE(KitePlant(parameters).outputs(thesisInputs()).tetherForce.norm(), 0.0);
}

void tst_KitePlant::noRelativeWindGivesGravityOnly()
{
    PlantParameters parameters;
    parameters.initialState.velocity = {5.0, 3.0, 0.0};
    const PlantOutputs y = KitePlant(parameters).outputs(thesisInputs());
    QCOMPARE(y.aerodynamicForce, Vector3d(Vector3d::Zero()));
    QCOMPARE(y.angleOfAttack, 0.0);
    QCOMPARE(y.gravitationalForce, Vector3d(0.0, 0.0, -5.0 * 9.81));
    QVERIFY(y.aerodynamicForce.allFinite());
}

void tst_KitePlant::freeFallIsExact()
{
    PlantParameters parameters;
    parameters.airDensity = 1e-3;  // as good as none: what is left is below the tolerance
    parameters.area = 1e-3;
    parameters.initialState.tetherLength = 1000.0;
    KitePlant plant(parameters);
    for (int i = 0; i < 100; ++i)
        plant.step(PlantInputs());
    COMPARE_NEAR(plant.state().position.z(), 50.0 - 0.5 * 9.81, 1e-4);
    COMPARE_NEAR(plant.state().velocity.z(), -9.81, 1e-4);
}

void tst_KitePlant::controlAnglesAndTetherLengthAreRamps()
{
    KitePlant plant;
    PlantInputs inputs = thesisInputs(-1.5);
    inputs.pitchSpeed = 20.0;
    inputs.yawSpeed = -30.0;
    for (int i = 0; i < 100; ++i)
        plant.step(inputs);
    COMPARE_NEAR(plant.state().pitchAngle, 29.0, 1e-12);
    COMPARE_NEAR(plant.state().yawAngle, -30.0, 1e-12);
    COMPARE_NEAR(plant.state().tetherLength, 98.5, 1e-12);
}

void tst_KitePlant::energyIsTheIntegralOfPower()
{
    KitePlant plant;
    double sum = 0.0, last = plant.outputs(thesisInputs(1.9)).power;
    for (int i = 0; i < 1000; ++i) {
        plant.step(thesisInputs(1.9));
        const double power = plant.outputs(thesisInputs(1.9)).power;
        sum += 0.5 * 0.010 * (last + power);
        last = power;
    }
    COMPARE_NEAR(plant.state().energy, sum, 1e-4 * sum);
    QVERIFY(sum > 0.0);
}

void tst_KitePlant::averagePowerSettlesWithItsTimeConstant()
{
    PlantParameters parameters;
    parameters.initialState.averagePower = 1000.0;
    parameters.initialState.tetherLength = 1000.0;  // slack: no power
    parameters.averagePowerTime = 2.0;
    KitePlant plant(parameters);
    for (int i = 0; i < 200; ++i)
        plant.step(PlantInputs());
    COMPARE_NEAR(plant.state().averagePower, 1000.0 * std::exp(-1.0), 1e-8);
}

void tst_KitePlant::mirroredFlightMirrorsTheTrajectory()
{
    const auto mirror = [](Vector3d vector) { return Vector3d(vector.x(), -vector.y(), vector.z()); };
    PlantParameters left, right;
    left.initialState = PlantParameters::stateAtRest(35.0, 20.0, 100.0);
    right.initialState = PlantParameters::stateAtRest(35.0, -20.0, 100.0);
    KitePlant a(left), b(right);
    PlantInputs u = thesisInputs(1.0), m = thesisInputs(1.0);
    m.windVelocity = mirror(u.windVelocity);
    for (int i = 0; i < 500; ++i) {
        u.yawSpeed = 40.0 * std::sin(0.02 * i);
        m.yawSpeed = -u.yawSpeed;
        a.step(u);
        b.step(m);
    }
    COMPARE_NEAR((a.state().position - mirror(b.state().position)).norm(), 0.0, 1e-10);
    COMPARE_NEAR((a.outputs(u).aerodynamicForce - mirror(b.outputs(m).aerodynamicForce)).norm(), 0.0, 1e-8);
    COMPARE_NEAR(a.state().energy, b.state().energy, 1e-8);
}

void tst_KitePlant::turnedWorldTurnsTheTrajectory()
{
    Eigen::Matrix3d turn;  // 90 deg about z
    turn << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    PlantParameters turned;
    turned.initialState.position = turn * turned.initialState.position;
    KitePlant a, b(turned);
    PlantInputs u = thesisInputs(1.0), v = u;
    v.windVelocity = turn * u.windVelocity;
    u.yawSpeed = v.yawSpeed = 25.0;
    for (int i = 0; i < 500; ++i) {
        a.step(u);
        b.step(v);
    }
    COMPARE_NEAR((turn * a.state().position - b.state().position).norm(), 0.0, 1e-10);
}

void tst_KitePlant::runge_KuttaIsOfOrderFourWhereSmooth()
{
    // Steady flight first, so that no spline knot and no slack tether spoils the order.
    KitePlant settled;
    for (int i = 0; i < 300; ++i)
        settled.step(thesisInputs(1.0));
    const auto fly = [&](double step) {
        PlantParameters parameters;
        parameters.step = step;
        parameters.initialState = settled.state();
        KitePlant plant(parameters);
        PlantInputs inputs = thesisInputs(1.0);
        inputs.yawSpeed = 20.0;
        const int steps = static_cast<int>(std::lround(0.8 / step));
        for (int i = 0; i < steps; ++i)
            plant.step(inputs);
        return plant.state().position;
    };
    const Vector3d truth = fly(0.0005);
    const double coarse = (fly(0.02) - truth).norm(), fine = (fly(0.01) - truth).norm();
    const double order = std::log2(coarse / fine);
    QVERIFY2(order > 3.8 && order < 4.3, qPrintable(QString::number(order)));
}

void tst_KitePlant::quasiSteadyFlightGivesThePublishedPower()
{
    // No gravity, wind along x, flying level through the axis of the wind: F and P of Loyd's
    // quasi-steady solution.
    PlantParameters parameters;
    parameters.gravity = 0.0;
    parameters.initialState = PlantParameters::stateAtRest(0.0, 0.0, 1e6);  // so far out that the sphere is a plane
    parameters.initialState.pitchAngle = 8.5;
    parameters.initialState.yawAngle = 90.0;
    KitePlant plant(parameters);
    PlantInputs inputs;
    inputs.windVelocity = {Vector3d(5.0, 3.0, 0.0).norm(), 0.0, 0.0};
    inputs.tetherSpeed = 1.94;
    for (int i = 0; i < 2000; ++i)
        plant.step(inputs);
    const PlantOutputs y = plant.outputs(inputs);
    COMPARE_NEAR(y.power, 3091.44, 0.5);
    COMPARE_NEAR(y.tetherForce.norm(), 1593.5, 0.3);
    COMPARE_NEAR(std::hypot(y.velocity.y(), y.velocity.z()), 16.26, 0.01);
}

void tst_KitePlant::fifthOfTheDragFliesFiveTimesAsFast()
{
    // The same angle of attack needs another pitch: beta_c = alpha - atan(c_d / c_l).
    const auto speed = [](double dragFactor) {
        const Aerodynamics::Coefficients c = Aerodynamics(dragFactor).coefficients(22.3);
        PlantParameters parameters;
        parameters.gravity = 0.0;
        parameters.dragFactor = dragFactor;
        parameters.tetherStiffness = 1e5;  // 80 kN must not stretch it far
        parameters.initialState = PlantParameters::stateAtRest(0.0, 0.0, 1e6);
        parameters.initialState.pitchAngle = 22.3 - std::atan2(c.drag, c.lift) * 180.0 / M_PI;
        parameters.initialState.yawAngle = 90.0;
        KitePlant plant(parameters);
        PlantInputs inputs;
        inputs.windVelocity = {Vector3d(5.0, 3.0, 0.0).norm(), 0.0, 0.0};
        for (int i = 0; i < 3000; ++i)
            plant.step(inputs);
        return std::hypot(plant.state().velocity.y(), plant.state().velocity.z());
    };
    COMPARE_NEAR(speed(1.0), 24.1, 0.2);  // published, with gravity
    COMPARE_NEAR(speed(0.2), 121.3, 1.0);
    COMPARE_NEAR(speed(0.2) / speed(1.0), 5.0, 0.01);
}

void tst_KitePlant::dynamicMaximumPowerIsNearTheQuasiSteadyOne()
{
    const double windAzimuth = 30.963756532073521;
    PlantParameters parameters;
    parameters.initialState = PlantParameters::stateAtRest(0.0, windAzimuth + 10.0, 100.0);
    parameters.initialState.tetherLength -= 1.55;  // 1550 N, as on the way
    const Vector3d &r = parameters.initialState.position;
    parameters.initialState.velocity = 16.0 * Vector3d(r.y(), -r.x(), 0.0).normalized();
    parameters.initialState.pitchAngle = 8.5;
    parameters.initialState.yawAngle = 82.24;  // flies level: the lift carries the weight
    KitePlant plant(parameters);
    double atWindAzimuth = 0.0;
    while (plant.outputs(thesisInputs()).bodyPositionOrientation.z() > windAzimuth) {
        plant.step(thesisInputs(1.9437));
        atWindAzimuth = plant.outputs(thesisInputs(1.9437)).power;
    }
    COMPARE_NEAR(atWindAzimuth, 3067.0, 30.0);
    COMPARE_NEAR(plant.state().position.z(), 0.0, 3.0);
}

void tst_KitePlant::wingAboveTheStationHasFiniteOutputs()
{
    PlantParameters parameters;
    parameters.initialState.position = {0.0, 0.0, 100.0};
    KitePlant plant(parameters);
    const PlantOutputs y = plant.outputs(thesisInputs());
    QVERIFY(y.aerodynamicForce.allFinite());
    QCOMPARE(y.bodyPositionOrientation, Vector3d(Vector3d::Zero()));
    plant.step(thesisInputs());
    QVERIFY(plant.state().position.allFinite());
}

void tst_KitePlant::referenceModeFliesThroughTheGround()
{
    PlantParameters parameters;
    parameters.initialState.position = {99.0, 0.0, 1.0};
    KitePlant plant(parameters);
    QVERIFY(!plant.hasCrashed());
    for (int i = 0; i < 200; ++i)
        plant.step(PlantInputs());
    QVERIFY(plant.state().position.z() < -1.0);
    QVERIFY(plant.outputs(PlantInputs()).crashed);
}

void tst_KitePlant::crashedWingIsHeld()
{
    PlantParameters parameters;
    parameters.groundContact = GroundContact::Hold;
    parameters.initialState.position = {99.0, 0.0, 1.0};
    KitePlant plant(parameters);
    while (!plant.hasCrashed())
        plant.step(PlantInputs());
    const PlantState crashed = plant.state();
    QCOMPARE(crashed.velocity.norm(), 0.0);
    plant.step(thesisInputs(-5.0));
    const PlantOutputs y = plant.outputs(thesisInputs(-5.0));
    QCOMPARE(y.position, crashed.position);
    QCOMPARE(y.tetherLength, crashed.tetherLength);
    QCOMPARE(y.power, 0.0);
    QCOMPARE(y.tetherForce.norm(), 0.0);
    QVERIFY(y.crashed);
    plant.reset();
    QVERIFY(!plant.hasCrashed());
    QCOMPARE(plant.state().position.z(), 1.0);
}

void tst_KitePlant::resetRepeatsTheFlightBitForBit()
{
    KitePlant plant;
    const auto fly = [&plant] {
        plant.reset();
        PlantInputs inputs = thesisInputs(1.0);
        for (int i = 0; i < 500; ++i) {
            inputs.yawSpeed = 30.0 * std::sin(0.03 * i);
            plant.step(inputs);
        }
        return plant.state();
    };
    const PlantState first = fly(), second = fly();
    QCOMPARE(std::memcmp(first.position.data(), second.position.data(), 3 * sizeof(double)), 0);
    QCOMPARE(std::memcmp(first.velocity.data(), second.velocity.data(), 3 * sizeof(double)), 0);
    QVERIFY(first.energy == second.energy && first.averagePower == second.averagePower);
}

void tst_KitePlant::fullAngleRangeChangesOnlyBackwardFlow()
{
    PlantParameters folded, full;
    full.angleOfAttackRange = AngleOfAttackRange::Full;
    PlantInputs inputs = thesisInputs();
    inputs.windVelocity = {0.0, 0.0, -8.0};  // onto the nose, from the zenith: ordinary flow
    const double ahead = KitePlant(folded).outputs(inputs).angleOfAttack;
    COMPARE_NEAR(KitePlant(full).outputs(inputs).angleOfAttack, ahead, 1e-12);
    inputs.windVelocity = {0.0, 0.0, 8.0};  // from behind
    const double folding = KitePlant(folded).outputs(inputs).angleOfAttack;
    COMPARE_NEAR(KitePlant(full).outputs(inputs).angleOfAttack, 180.0 - folding, 1e-12);
}

QTEST_APPLESS_MAIN(tst_KitePlant)
#include "tst_KitePlant.moc"

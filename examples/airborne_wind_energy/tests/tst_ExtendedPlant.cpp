// SPDX-License-Identifier: Apache-2.0
#include "ExtendedPlant.h"
#include "ExtendedTrajectory.h"

#include "Near.h"

#include <Eigen/Eigenvalues>
#include <QtCore/QElapsedTimer>

#include <algorithm>
#include <cmath>
#include <random>

using namespace awe;

Q_DECLARE_METATYPE(awe::PlantOptions)

namespace {

/// A kite with its options.
struct Example
{
    PlantParameters kite;
    PlantOptions options;

    ExtendedPlant plant() const { return ExtendedPlant(kite, options); }
};

/// Options that change nothing, so that no shortcut to KitePlant is taken.
Example neutralOptions()
{
    Example parameters;
    parameters.options.air.profile = WindProfile::Power;
    parameters.options.air.exponent = 0.0;
    return parameters;
}

Example everything()
{
    Example parameters;
    parameters.options.air.profile = WindProfile::Log;
    parameters.options.air.isThinner = true;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.options.steering.kind = SteeringKind::TurnRate;
    parameters.options.hasMachine = parameters.options.hasTurbines = true;
    return parameters;
}

PlantInputs windAlone(const Eigen::Vector3d &wind)
{
    PlantInputs inputs;
    inputs.windVelocity = wind;
    return inputs;
}

/// Inputs as an autopilot gives them, with a seed.
class Commands
{
public:
    PlantInputs next()
    {
        PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
        inputs.pitchSpeed = 20.0 * m_normal(m_source);
        inputs.yawSpeed = 40.0 * m_normal(m_source);
        inputs.tetherSpeed = m_normal(m_source);
        inputs.steering = 0.3 * m_normal(m_source);
        return inputs;
    }

private:
    std::mt19937 m_source{7};
    std::normal_distribution<double> m_normal;
};

/// The wing hangs below the winch, without wind: the tether stretches under all that is below.
Example hanging()
{
    Example parameters;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.kite.initialState.velocity.setZero();
    parameters.kite.initialState.tetherLength = 100.0;
    parameters.kite.initialState.position = {0.0, 0.0, -100.0};
    return parameters;
}

double tensionOfHanging(const ExtendedPlant &plant, int segment)
{
    const TetherParameters &tether = plant.options().tether;
    const double node = tether.massPerLength() * 100.0 / tether.segments;
    return plant.parameters().gravity * (plant.parameters().mass + 0.5 * node + node * (tether.segments - 1 - segment));
}

void hang(ExtendedPlant *plant)
{
    const TetherParameters &tether = plant->options().tether;
    double depth = 0.0;
    for (int segment = 0; segment < tether.segments; ++segment) {
        depth += 100.0 / tether.segments * (1.0 + tensionOfHanging(*plant, segment) / tether.axialStiffness);
        plant->setPoint(segment + 1, {0.0, 0.0, -depth}, Eigen::Vector3d::Zero());
    }
}

}  // namespace

/// The plant with its options, against the plant of the thesis, figures that others have published,
/// exact solutions, and flights of an independent implementation.
class tst_ExtendedPlant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void withoutOptionsItIsThePlantOfTheThesisBitForBit();
    void withOptionsThatChangeNothingItIsThePlantOfTheThesis();
    void oneSegmentWithoutMassIsTheSpringTether();
    void recordedFlightsAreReproduced_data();
    void recordedFlightsAreReproduced();
    void densityAndPowerLawAreThosePublished();
    void logLawIsOneAtItsReferenceHeight();
    void windBelowTwoMetresIsThatOfTwoMetres();
    void turbulenceIsTheSameAtEveryHeight();
    void dragOfTheTetherIsThatPublished();
    void hangingTetherCarriesWhatIsBelow();
    void hangingTetherStaysAtRest();
    void hangingTetherSwingsInItsFirstMode();
    void bestTurbinesAreThosePublished();
    void dragModeIsInBalanceAtTheOptimumOfTheThesis();
    void machineAtTheOptimumIsThatOfItsEquations_data();
    void machineAtTheOptimumIsThatOfItsEquations();
    void straightTetherAddsDragAndMass();
    void steeringFollowsItsActuator();
    void weightTurnsTheNoseDown();
    void energiesOfTheWinchBalance();
    void resetBeginsTheSameFlight();
    void groundHoldsTheWing();
    void divergingPlantIsNotCalledACrash();
    void shortSegmentsAreRefused();
    void reeledInTetherTakesNoLongerThanAShortOne();
    void invalidParametersAreRefused_data();
    void invalidParametersAreRefused();
};

void tst_ExtendedPlant::withoutOptionsItIsThePlantOfTheThesisBitForBit()
{
    const Example parameters;
    QVERIFY(parameters.options.isThesis());
    ExtendedPlant plant = parameters.plant();
    KitePlant thesis(parameters.kite);
    Commands commands;
    for (int cycle = 0; cycle < 2000; ++cycle) {
        const PlantInputs inputs = commands.next();
        const PlantOutputs seen = plant.outputs(inputs), expected = thesis.outputs(inputs);
        QVERIFY(seen.position == expected.position);
        QVERIFY(seen.tetherForce == expected.tetherForce);
        QVERIFY(seen.energy == expected.energy);
        QVERIFY(plant.position(1) == expected.position);
        plant.step(inputs);
        thesis.step(inputs);
    }
}

void tst_ExtendedPlant::withOptionsThatChangeNothingItIsThePlantOfTheThesis()
{
    const Example parameters = neutralOptions();
    QVERIFY(!parameters.options.isThesis());
    ExtendedPlant plant = parameters.plant();
    KitePlant thesis(parameters.kite);
    Commands commands;
    for (int cycle = 0; cycle < 500; ++cycle) {
        const PlantInputs inputs = commands.next();
        const PlantOutputs seen = plant.outputs(inputs), expected = thesis.outputs(inputs);
        COMPARE_NEAR((seen.position - expected.position).norm(), 0.0, 1e-9);
        COMPARE_NEAR((seen.aerodynamicForce - expected.aerodynamicForce).norm(), 0.0, 1e-6);
        COMPARE_NEAR((seen.tetherForce - expected.tetherForce).norm(), 0.0, 1e-6);
        COMPARE_NEAR(seen.power, expected.power, 1e-6);
        COMPARE_NEAR(seen.bodyPositionOrientation.y(), expected.bodyPositionOrientation.y(), 1e-9);
        plant.step(inputs);
        thesis.step(inputs);
    }
}

void tst_ExtendedPlant::oneSegmentWithoutMassIsTheSpringTether()
{
    Example parameters;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.options.tether.segments = 1;
    parameters.options.tether.density = parameters.options.tether.dragCoefficient
        = parameters.options.tether.segmentDamping = 0.0;
    parameters.options.tether.axialStiffness
        = parameters.kite.tetherStiffness * parameters.kite.initialState.tetherLength;
    ExtendedPlant plant = parameters.plant();
    PlantParameters fine = parameters.kite;
    fine.step /= 5.0;  // the plant with segments has five substeps at this length
    KitePlant thesis(fine);
    const PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    for (int cycle = 0; cycle < 500; ++cycle) {
        plant.step(inputs);
        for (int i = 0; i < 5; ++i)
            thesis.step(inputs);
    }
    COMPARE_NEAR((plant.position(1) - thesis.state().position).norm(), 0.0, 1e-9);
    COMPARE_NEAR((plant.velocity(1) - thesis.state().velocity).norm(), 0.0, 1e-9);
}

void tst_ExtendedPlant::recordedFlightsAreReproduced_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<double>("tolerance");
    QTest::newRow("six segments, turns") << "p1_tether_turn" << 1e-9;
    QTest::newRow("slack and a snatch: rounding decides") << "p3_tether_slack" << 1e-5;
    QTest::newRow("machine") << "p5_drive" << 1e-9;
    QTest::newRow("drag mode") << "p7_drag_mode" << 1e-9;
    QTest::newRow("short tether, log wind, a slack segment") << "p8_short_tether" << 1e-5;
}

void tst_ExtendedPlant::recordedFlightsAreReproduced()
{
    QFETCH(QString, name);
    QFETCH(double, tolerance);
    ExtendedTrajectory recorded;
    const std::string complaint = recorded.load(std::string(AWE_REFERENCE "/") + name.toStdString() + ".csv");
    QVERIFY2(complaint.empty(), complaint.c_str());
    const ExtendedTrajectory flown = recorded.replayed();
    for (std::size_t column = 0; column < ExtendedTrajectory::columnCount; ++column) {
        double largest = 0.0, worst = 0.0;
        for (std::size_t row = 0; row < recorded.rows().size(); ++row) {
            const double expected = recorded.rows()[row][column];
            largest = std::max(largest, std::abs(expected));
            worst = std::max(worst, std::abs(flown.rows()[row][column] - expected));
        }
        QVERIFY2(worst <= tolerance * largest,
                 qPrintable(QStringLiteral("%1: %2 of %3")
                                .arg(QLatin1String(ExtendedTrajectory::columnNames()[column]))
                                .arg(worst)
                                .arg(largest)));
    }
}

void tst_ExtendedPlant::densityAndPowerLawAreThosePublished()
{
    AirParameters parameters;
    parameters.isThinner = true;
    parameters.profile = WindProfile::Power;
    parameters.referenceHeight = 6.0;
    const Air air(parameters, 1.225);
    COMPARE_NEAR(air.density(100.0), 1.210756, 5e-7);
    COMPARE_NEAR(air.windFactor(10.0), 1.0757037, 5e-8);
    COMPARE_NEAR(air.windFactor(100.0), 1.494685, 5e-7);
}

void tst_ExtendedPlant::logLawIsOneAtItsReferenceHeight()
{
    AirParameters parameters;
    parameters.profile = WindProfile::Log;
    const Air air(parameters, 1.2);
    COMPARE_NEAR(air.windFactor(50.0), 1.0, 1e-15);
    COMPARE_NEAR(air.windFactor(100.0), std::log(100.0 / 0.03) / std::log(50.0 / 0.03), 1e-15);
    COMPARE_NEAR(air.density(100.0), 1.2, 0.0);
}

void tst_ExtendedPlant::windBelowTwoMetresIsThatOfTwoMetres()
{
    AirParameters parameters;
    parameters.profile = WindProfile::Log;
    const Air air(parameters, 1.2);
    QCOMPARE(air.windFactor(0.001), air.windFactor(2.0));
    QCOMPARE(air.windFactor(-5.0), air.windFactor(2.0));
}

void tst_ExtendedPlant::turbulenceIsTheSameAtEveryHeight()
{
    Example parameters;
    parameters.options.air.profile = WindProfile::Power;
    const ExtendedPlant plant = parameters.plant();
    PlantInputs inputs;
    inputs.turbulence = {0.3, -0.2, 0.1};
    inputs.windVelocity = inputs.turbulence;  // no mean wind
    QCOMPARE((plant.outputs(inputs).inputs.windVelocity - inputs.turbulence).norm(), 0.0);
    QCOMPARE((plant.details(inputs).windAt6m - inputs.turbulence).norm(), 0.0);
}

void tst_ExtendedPlant::dragOfTheTetherIsThatPublished()
{
    AirParameters air;
    air.isThinner = true;
    TetherParameters tether;
    tether.diameter = 0.1;  // d L = 20 m^2
    const Eigen::Vector3d drag = tether.drag({35.1, 52.2, 69.3}, 200.0, Air(air, 1.225).density(10.0));
    COMPARE_NEAR(drag.x(), 38506.7140169, 1e-4);
    COMPARE_NEAR(drag.y(), 57266.39520463, 1e-4);
    COMPARE_NEAR(drag.z(), 76026.07639235, 1e-4);
}

void tst_ExtendedPlant::hangingTetherCarriesWhatIsBelow()
{
    ExtendedPlant plant = hanging().plant();
    hang(&plant);
    const PlantOutputs y = plant.outputs(PlantInputs());
    COMPARE_NEAR(y.groundTension, 57.2314235531, 1e-7);
    COMPARE_NEAR(y.tetherForce.norm(), 49.7937657776, 1e-7);
}

void tst_ExtendedPlant::hangingTetherStaysAtRest()
{
    ExtendedPlant plant = hanging().plant();
    hang(&plant);
    std::array<Eigen::Vector3d, 6> start;
    for (int point = 1; point <= 6; ++point)
        start[std::size_t(point - 1)] = plant.position(point);
    for (int cycle = 0; cycle < 200; ++cycle)
        plant.step(PlantInputs());
    for (int point = 1; point <= 6; ++point)
        COMPARE_NEAR((plant.position(point) - start[std::size_t(point - 1)]).norm(), 0.0, 1e-9);
}

void tst_ExtendedPlant::hangingTetherSwingsInItsFirstMode()
{
    Example parameters = hanging();
    parameters.options.tether.segmentDamping = 0.0;
    const double node = parameters.options.tether.massPerLength() * 100.0 / 6.0;
    const double spring = parameters.options.tether.axialStiffness * 6.0 / 100.0;
    Eigen::Matrix<double, 6, 1> mass = Eigen::Matrix<double, 6, 1>::Constant(node);
    mass[5] = parameters.kite.mass + 0.5 * node;
    Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
    for (int i = 0; i < 6; ++i) {
        stiffness(i, i) = i < 5 ? 2.0 * spring : spring;
        if (i > 0)
            stiffness(i, i - 1) = stiffness(i - 1, i) = -spring;
    }
    const Eigen::Matrix<double, 6, 1> root = mass.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(root.asDiagonal() * stiffness
                                                                           * root.asDiagonal());
    const double frequency = std::sqrt(modes.eigenvalues()[0]);
    COMPARE_NEAR(frequency, 34.0183, 5e-5);
    // A rod with the wing at its end: b tan(b) = mass of the rod / of the wing, b = w length / c.
    const double massRatio = 6.0 * node / parameters.kite.mass;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (middle * std::tan(middle) < massRatio ? low : high) = middle;
    }
    COMPARE_NEAR(low * std::sqrt(spring / 6.0 / (6.0 * node)), 34.0314, 5e-5);

    ExtendedPlant plant = parameters.plant();
    hang(&plant);
    const double rest = plant.position(6).z();
    const Eigen::Matrix<double, 6, 1> shape = root.cwiseProduct(modes.eigenvectors().col(0));
    for (int point = 1; point <= 6; ++point)
        plant.setPoint(point, plant.position(point) - 1e-4 * shape[point - 1] / shape[5] * Eigen::Vector3d::UnitZ(),
                       Eigen::Vector3d::Zero());
    // Where the wing passes its rest upwards, by interpolation.
    std::vector<double> passes;
    double before = plant.position(6).z() - rest;
    for (int cycle = 1; cycle <= 400; ++cycle) {
        plant.step(PlantInputs());
        const double now = plant.position(6).z() - rest;
        if (before < 0.0 && now >= 0.0)
            passes.push_back(0.01 * (cycle - now / (now - before)));
        before = now;
    }
    QVERIFY(passes.size() > 15);
    const double period = (passes.back() - passes.front()) / double(passes.size() - 1);
    COMPARE_NEAR(6.28318530717958648 / period, frequency, 2e-3 * frequency);
}

/// Power of turbines on a wing that flies across the wind of the thesis [W] (thesis, equations
/// 2.11, 2.14, 2.16). \param share  c_dt / c_d
static double turbinePower(double angleOfAttack, double share)
{
    const Aerodynamics::Coefficients wing = Aerodynamics().coefficients(angleOfAttack);
    const double turbines = share * wing.drag, drag = wing.drag + turbines;
    const double airspeed = std::sqrt(34.0) * std::hypot(wing.lift, drag) / drag;
    const PlantParameters kite;
    return 0.5 * kite.airDensity * kite.area * turbines * airspeed * airspeed * airspeed;
}

void tst_ExtendedPlant::bestTurbinesAreThosePublished()
{
    // Half of c_d, the rule of the thesis, at its angle and at the best one.
    COMPARE_NEAR(turbinePower(21.977, 0.5), 3410.80, 0.01);
    COMPARE_NEAR(turbinePower(22.570, 0.5), 3413.69, 0.01);
    // Without the approximation that c_l is much larger than c_d.
    COMPARE_NEAR(turbinePower(22.764, 0.6265), 3458.55, 0.01);
    // Both are maxima.
    for (const double turn : {-0.02, 0.02}) {
        QVERIFY(turbinePower(22.570 + turn, 0.5) < turbinePower(22.570, 0.5));
        QVERIFY(turbinePower(22.764 + turn, 0.6265) < turbinePower(22.764, 0.6265));
        QVERIFY(turbinePower(22.764, 0.6265 + turn) < turbinePower(22.764, 0.6265));
    }
}

void tst_ExtendedPlant::dragModeIsInBalanceAtTheOptimumOfTheThesis()
{
    const double alpha = 21.977, windSpeed = std::sqrt(34.0);
    const Aerodynamics::Coefficients wing = Aerodynamics().coefficients(alpha);
    const double turbines = 0.5 * wing.drag;
    const double total = std::hypot(wing.lift, wing.drag + turbines);
    const double airspeed = windSpeed * total / (wing.drag + turbines);
    COMPARE_NEAR(airspeed, 17.256, 5e-4);

    // Level flight across the wind at the horizon, without weight: the wing flies in +y.
    Example parameters;
    parameters.options.hasTurbines = true;
    parameters.kite.gravity = 0.0;
    PlantState &start = parameters.kite.initialState;
    const double flight = std::sqrt(airspeed * airspeed - windSpeed * windSpeed);
    start.position = {100.0, 0.0, 0.0};
    start.velocity = {0.0, flight, 0.0};
    start.yawAngle = -90.0;
    start.pitchAngle = alpha - std::atan2(windSpeed, flight) * degreesPerRadian;
    const ExtendedPlant plant = parameters.plant();
    PlantInputs inputs = windAlone({windSpeed, 0.0, 0.0});
    inputs.turbineCoefficient = turbines;
    const PlantOutputs y = plant.outputs(inputs);
    COMPARE_NEAR(y.angleOfAttack, alpha, 1e-9);
    COMPARE_NEAR(plant.details(inputs).turbinePower, 3410.80, 0.05);
    const Eigen::Vector3d relativeWind(windSpeed, -flight, 0.0);
    const Eigen::Vector3d force = y.aerodynamicForce
        + 0.5 * parameters.kite.airDensity * parameters.kite.area * turbines * airspeed * relativeWind;
    COMPARE_NEAR(force.x(), 1754.8, 0.1);  // the tension
    COMPARE_NEAR(force.y(), 0.0, 1e-6);    // it neither gains speed nor loses it
}

void tst_ExtendedPlant::machineAtTheOptimumIsThatOfItsEquations_data()
{
    QTest::addColumn<double>("force");
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("power");
    QTest::newRow("reel out at the maximum power") << 1593.5 << 1.9437 << 2760.1;
    QTest::newRow("reel in") << 300.0 << -4.0 << -1581.4;
}

void tst_ExtendedPlant::machineAtTheOptimumIsThatOfItsEquations()
{
    QFETCH(double, force);
    QFETCH(double, speed);
    QFETCH(double, power);
    WinchDrive drive;
    WinchDriveInputs inputs;
    inputs.hasCommand = inputs.enable = true;
    inputs.speedSetpoint = speed / drive.parameters().leverage();
    inputs.tetherForce = force;
    for (int i = 0; i < 10000; ++i)
        drive.step(inputs);
    COMPARE_NEAR(drive.electricalPower(), power, 0.1);
    if (speed > 0.0)
        COMPARE_NEAR(drive.current(), -30.771, 1e-3);
}

void tst_ExtendedPlant::straightTetherAddsDragAndMass()
{
    Example parameters;
    parameters.options.tether.kind = TetherKind::Straight;
    const ExtendedPlant straight = parameters.plant();
    const KitePlant spring(parameters.kite);
    const PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    // c_dT d l_t / (4 A)
    COMPARE_NEAR(straight.outputs(inputs).dragCoefficient - spring.outputs(inputs).dragCoefficient,
                 0.958 * 0.004 * 100.0 / 40.0, 1e-12);
    // In calm air the wing falls freely: a heavier one as fast. With a force it moves less.
    ExtendedPlant pulled = parameters.plant();
    KitePlant light(parameters.kite);
    PlantInputs reelIn = inputs;
    reelIn.tetherSpeed = -50.0;
    pulled.step(reelIn);
    light.step(reelIn);
    QVERIFY(pulled.velocity(1).norm() < light.state().velocity.norm());
}

void tst_ExtendedPlant::steeringFollowsItsActuator()
{
    Example parameters;
    parameters.options.steering.kind = SteeringKind::TurnRate;
    ExtendedPlant plant = parameters.plant();
    PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    inputs.steering = 5.0;  // more than there is
    double last = 0.0;
    for (int cycle = 0; cycle < 100; ++cycle) {
        plant.step(inputs);
        const double now = plant.details(inputs).steering;
        QVERIFY(now <= 1.0 && now >= last && now - last <= 0.02 + 1e-12);  // 2 1/s
        last = now;
    }
    COMPARE_NEAR(last, 1.0, 1e-3);
}

void tst_ExtendedPlant::weightTurnsTheNoseDown()
{
    Example parameters;
    parameters.options.steering.kind = SteeringKind::TurnRate;
    parameters.kite.initialState.yawAngle = -90.0;  // nose to larger azimuth
    parameters.kite.mass = 1e6;                     // it stays where it is
    parameters.kite.gravity = 0.0;
    ExtendedPlant plant = parameters.plant();
    const PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    const double airspeed = std::sqrt(34.0), elevation = 30.0 * radiansPerDegree;
    plant.step(inputs);
    const double turn = -(plant.outputs(inputs).bodyControlOrientation.z() + 90.0) / 0.01 * radiansPerDegree;
    COMPARE_NEAR(turn, 0.076 / airspeed * std::cos(elevation), 1e-6);
}

void tst_ExtendedPlant::energiesOfTheWinchBalance()
{
    Example parameters;
    parameters.options.hasMachine = true;
    ExtendedPlant plant = parameters.plant();
    PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    inputs.tetherSpeed = 2.0;
    for (int cycle = 0; cycle < 1000; ++cycle)
        plant.step(inputs);
    const PlantDetails details = plant.details(inputs);
    const WinchEnergies &e = details.energies;
    COMPARE_NEAR(plant.outputs(inputs).energy, e.tether, 1e-2 * e.tether);
    const double kinetic = 0.5 * parameters.options.machine.inertia() * details.machineSpeed * details.machineSpeed;
    COMPARE_NEAR(e.tether, e.electrical + e.copper + e.converter + e.friction + e.brake + kinetic, 1e-6 * e.tether);
    COMPARE_NEAR(details.tetherSpeed, 2.0, 0.05);
}

void tst_ExtendedPlant::resetBeginsTheSameFlight()
{
    ExtendedPlant plant = everything().plant();
    const auto fly = [&plant] {
        Commands commands;
        for (int cycle = 0; cycle < 300; ++cycle)
            plant.step(commands.next());
        return plant.position(6);
    };
    const Eigen::Vector3d first = fly();
    plant.reset();
    QVERIFY(fly() == first);
}

void tst_ExtendedPlant::groundHoldsTheWing()
{
    Example parameters = everything();
    parameters.kite.groundContact = GroundContact::Hold;
    parameters.kite.initialState.position = {90.0, 0.0, 0.5};
    parameters.kite.initialState.velocity = {0.0, 0.0, -5.0};
    ExtendedPlant plant = parameters.plant();
    const PlantInputs inputs;
    for (int cycle = 0; cycle < 100; ++cycle)
        plant.step(inputs);
    QVERIFY(plant.hasCrashed());
    const Eigen::Vector3d where = plant.position(6);
    plant.step(inputs);
    QVERIFY(plant.position(6) == where);
    const PlantOutputs y = plant.outputs(inputs);
    QVERIFY(y.crashed);
    QCOMPARE(y.velocity.norm() + y.tetherForce.norm() + y.power, 0.0);
}

/// A crash holds the wing, with a speed of 0: the divergence would be hidden.
void tst_ExtendedPlant::divergingPlantIsNotCalledACrash()
{
    Example parameters;
    parameters.kite.groundContact = GroundContact::Hold;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.options.tether.axialStiffness = 1e9;
    ExtendedPlant plant = parameters.plant();
    const PlantInputs inputs = windAlone({5.0, 3.0, 0.0});
    for (int cycle = 0; cycle < 100; ++cycle)
        plant.step(inputs);
    QVERIFY(!std::isfinite(plant.velocity(6).norm()));
    QVERIFY(!plant.hasCrashed());
}

void tst_ExtendedPlant::shortSegmentsAreRefused()
{
    Example parameters;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.kite.initialState.tetherLength = 0.2;
    QCOMPARE(parameters.options.validateFor(parameters.kite),
             std::string("tether length at the start is 0.2 m; choose a value from 0.3 to 1e+06 m"));
    parameters.options.mast.isPresent = true;  // the flight begins there
    QCOMPARE(parameters.options.validateFor(parameters.kite), std::string());
    parameters.options.tether.segments = 0;
    QCOMPARE(parameters.options.validateFor(parameters.kite), parameters.options.validate());
}

/// The number of substeps has an end.
void tst_ExtendedPlant::reeledInTetherTakesNoLongerThanAShortOne()
{
    Example parameters;
    parameters.options.tether.kind = TetherKind::Segments;
    parameters.kite.initialState.tetherLength = 1e-9;
    ExtendedPlant plant = parameters.plant();
    QElapsedTimer timer;
    timer.start();
    plant.step(windAlone({5.0, 3.0, 0.0}));
    QVERIFY2(timer.elapsed() < 5000, qPrintable(QString::number(timer.elapsed())));
}

void tst_ExtendedPlant::invalidParametersAreRefused_data()
{
    QTest::addColumn<PlantOptions>("parameters");
    QTest::addColumn<QString>("message");
    PlantOptions parameters;
    parameters.tether.segments = 21;
    QTest::newRow("segments") << parameters << "segments is 21; choose a value from 1 to 20";
    parameters = PlantOptions();
    parameters.tether.diameter = 1.0;
    QTest::newRow("tether") << parameters << "diameter is 1 m; choose a value from 0.0001 to 0.1 m";
    parameters = PlantOptions();
    parameters.tether.kind = TetherKind::Segments;
    parameters.tether.density = 0.0;
    QTest::newRow("nodes without mass") << parameters
                                        << "density of the tether is 0 kg/m³; choose a value from 1 to 20000 kg/m³";
    parameters = PlantOptions();
    parameters.air.roughness = 0.0;
    QTest::newRow("air") << parameters << "roughness is 0 m; choose a value from 1e-06 to 1 m";
    parameters = PlantOptions();
    parameters.steering.turnRateFactor = std::nan("");
    QTest::newRow("steering") << parameters << "turnRateFactor is nan rad/m; choose a value from 0.001 to 100 rad/m";
    parameters = PlantOptions();
    parameters.machine.drumRadius = 0.0;
    QTest::newRow("machine") << parameters << "drumRadius is 0 m; choose a value from 0.001 to 100 m";
}

void tst_ExtendedPlant::invalidParametersAreRefused()
{
    QFETCH(PlantOptions, parameters);
    QFETCH(QString, message);
    QCOMPARE(QString::fromStdString(parameters.validate()), message);
}

QTEST_APPLESS_MAIN(tst_ExtendedPlant)
#include "tst_ExtendedPlant.moc"

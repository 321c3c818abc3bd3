// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"

#include "Near.h"

using namespace awe;

/// Flights of half an hour: what the controllers are for.
class tst_ClosedLoopFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void calmFlightReachesItsFigures();
    void tunedGainsGiveMorePower_data();
    void tunedGainsGiveMorePower();
    void turbulentFlightReachesItsFigures_data();
    void turbulentFlightReachesItsFigures();
    void everyWindIsFlown_data();
    void everyWindIsFlown();
    void forceLimitIsKeptInEveryWind_data();
    void forceLimitIsKeptInEveryWind();
    void everyInitialStateIsFlown_data();
    void everyInitialStateIsFlown();
    void deadTimeHardlyMatters_data();
    void deadTimeHardlyMatters();
    void singlePrecisionSignalsHardlyMatter();
    void gustIsSurvived();
    void strongTurbulenceIsSurvivedByRecovering();
    void deadTimeIsCountedInCycles();
    void plantOutputsPrecedeItsInputsWithoutDeadTime();
    void real32SignalsAreRounded();
    void resetRepeatsTheFlightBitForBit();
    void badParametersAreNamed();

private:
    static ClosedLoopParameters inWind(double speed);
    static FlightReport fly(const ClosedLoopParameters &parameters);
};

ClosedLoopParameters tst_ClosedLoopFlight::inWind(double speed)
{
    ClosedLoopParameters parameters;
    parameters.wind.meanVelocity *= speed / parameters.wind.meanVelocity.norm();
    return parameters;
}

FlightReport tst_ClosedLoopFlight::fly(const ClosedLoopParameters &parameters)
{
    ClosedLoopFlight flight(parameters);
    flight.fly(1800.0);
    return flight.report();
}

void tst_ClosedLoopFlight::calmFlightReachesItsFigures()
{
    const FlightReport report = fly(ClosedLoopParameters());
    QVERIFY2(report.eta >= 0.60, qPrintable(QString::number(report.eta)));
    QVERIFY2(report.minimumAltitude >= 25.0, qPrintable(QString::number(report.minimumAltitude)));
    QVERIFY(report.pumpingCycles >= 18);
    QCOMPARE(report.recoveries, 0);
    QVERIFY(!report.crashed);
    QCOMPARE(report.cycles, std::int64_t(180000));
    QVERIFY(report.maximumTetherForce < 2300.0);
    QVERIFY(report.reelOutPower > 2300.0 && report.reelInPower < 0.0);
    COMPARE_NEAR(report.energy / report.duration, report.meanPower, 0.03 * report.meanPower);
}

void tst_ClosedLoopFlight::tunedGainsGiveMorePower_data()
{
    QTest::addColumn<int>("deadTime");
    QTest::newRow("same cycle") << 0;
    QTest::newRow("default links") << 2;
}

void tst_ClosedLoopFlight::tunedGainsGiveMorePower()
{
    QFETCH(int, deadTime);
    ClosedLoopParameters parameters;
    parameters.gains = AutopilotGains::tuned();
    parameters.deadTime = deadTime;
    const FlightReport report = fly(parameters);
    QVERIFY2(report.eta >= 0.67, qPrintable(QString::number(report.eta)));
    QVERIFY(report.minimumAltitude >= 15.0);
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::turbulentFlightReachesItsFigures_data()
{
    QTest::addColumn<int>("seed");
    QTest::addColumn<int>("deadTime");
    for (int deadTime : {0, 2}) {
        for (int seed = 1; seed <= 8; ++seed)
            QTest::addRow("seed %d, dead time %d", seed, deadTime) << seed << deadTime;
    }
}

void tst_ClosedLoopFlight::turbulentFlightReachesItsFigures()
{
    QFETCH(int, seed);
    QFETCH(int, deadTime);
    ClosedLoopParameters parameters;
    parameters.deadTime = deadTime;
    parameters.wind.turbulenceIntensity = 0.15;
    parameters.wind.seed = static_cast<std::uint64_t>(seed);
    const FlightReport report = fly(parameters);
    const double reach = deadTime == 0 ? 0.555 : 0.56;  // worst seen: 0.5596 and 0.5616
    QVERIFY2(report.etaPerMeanCubedWind >= reach, qPrintable(QString::number(report.etaPerMeanCubedWind)));
    QVERIFY2(report.minimumAltitude >= 15.0, qPrintable(QString::number(report.minimumAltitude)));
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::everyWindIsFlown_data()
{
    QTest::addColumn<double>("speed");
    for (int speed : {4, 6, 8, 10, 12})
        QTest::addRow("%d m/s", speed) << double(speed);
}

void tst_ClosedLoopFlight::everyWindIsFlown()
{
    QFETCH(double, speed);
    const FlightReport report = fly(inWind(speed));
    QVERIFY2(report.eta >= 0.53, qPrintable(QString::number(report.eta)));
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::forceLimitIsKeptInEveryWind_data()
{
    everyWindIsFlown_data();
}

void tst_ClosedLoopFlight::forceLimitIsKeptInEveryWind()
{
    QFETCH(double, speed);
    ClosedLoopParameters parameters = inWind(speed);
    parameters.gains.forceLimit = 4000.0;
    const FlightReport report = fly(parameters);
    QVERIFY2(report.maximumTetherForce <= 4000.0, qPrintable(QString::number(report.maximumTetherForce)));
    QVERIFY2(report.eta >= (speed <= 9.0 ? 0.53 : 0.38), qPrintable(QString::number(report.eta)));
    QVERIFY(report.minimumAltitude >= 20.0);
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::everyInitialStateIsFlown_data()
{
    QTest::addColumn<double>("elevation");
    QTest::addColumn<double>("azimuth");
    QTest::addColumn<double>("distance");
    for (int elevation : {15, 40, 70}) {
        for (int azimuth : {-60, 0, 60}) {
            for (int distance : {70, 180})
                QTest::addRow("%d deg high, %d deg aside, %d m", elevation, azimuth, distance)
                    << double(elevation) << double(azimuth) << double(distance);
        }
    }
}

void tst_ClosedLoopFlight::everyInitialStateIsFlown()
{
    QFETCH(double, elevation);
    QFETCH(double, azimuth);
    QFETCH(double, distance);
    ClosedLoopParameters parameters;
    parameters.plant.initialState = PlantParameters::stateAtRest(elevation, azimuth + 30.963756532073521, distance);
    const FlightReport report = fly(parameters);
    QVERIFY2(report.eta >= 0.60, qPrintable(QString::number(report.eta)));
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::deadTimeHardlyMatters_data()
{
    QTest::addColumn<int>("cycles");
    for (int cycles : {0, 1, 2, 3, 5, 8, 12, 20})
        QTest::addRow("%d cycles", cycles) << cycles;
}

void tst_ClosedLoopFlight::deadTimeHardlyMatters()
{
    QFETCH(int, cycles);
    ClosedLoopParameters parameters;
    parameters.deadTime = cycles;
    const FlightReport report = fly(parameters);
    QVERIFY2(report.eta >= 0.60, qPrintable(QString::number(report.eta)));
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::singlePrecisionSignalsHardlyMatter()
{
    ClosedLoopParameters parameters;
    const double exact = fly(parameters).eta;
    parameters.precision = SignalPrecision::Real32;
    COMPARE_NEAR(fly(parameters).eta, exact, 0.005);
}

void tst_ClosedLoopFlight::gustIsSurvived()
{
    for (double amplitude : {-0.4, 0.8}) {
        ClosedLoopParameters parameters;
        parameters.wind.gustAmplitude = amplitude;
        parameters.wind.gustStart = 100.0;
        const FlightReport report = fly(parameters);
        QVERIFY(!report.crashed);
        QVERIFY(report.eta >= 0.58);
    }
}

void tst_ClosedLoopFlight::strongTurbulenceIsSurvivedByRecovering()
{
    ClosedLoopParameters parameters;
    parameters.wind.turbulenceIntensity = 0.25;
    parameters.wind.seed = 10;
    const FlightReport report = fly(parameters);
    QVERIFY(report.recoveries > 0);
    QVERIFY(!report.crashed);
}

void tst_ClosedLoopFlight::deadTimeIsCountedInCycles()
{
    for (int cycles : {0, 1, 2, 5}) {
        ClosedLoopParameters parameters;
        parameters.plant.initialState = PlantParameters::stateAtRest(30.0, 60.0, 100.0);  // aside: yaws at once
        parameters.deadTime = cycles;
        ClosedLoopFlight flight(parameters);
        const double yawAngle = flight.plant().state().yawAngle;
        int silent = -1;
        do
            flight.step();
        while (++silent < 100 && flight.plant().state().yawAngle == yawAngle);
        QCOMPARE(silent, cycles);
    }
}

void tst_ClosedLoopFlight::plantOutputsPrecedeItsInputsWithoutDeadTime()
{
    ClosedLoopParameters parameters;
    parameters.deadTime = 0;
    ClosedLoopFlight flight(parameters);
    flight.fly(10.0);  // reels out
    const AutopilotOutputs before = flight.autopilotOutputs();
    const PlantState state = flight.plant().state();
    flight.step();
    const AutopilotOutputs now = flight.autopilotOutputs();
    QVERIFY(before.tetherSpeed > 0.0 && now.tetherSpeed != before.tetherSpeed);
    QCOMPARE(flight.outputs().position, state.position);
    QCOMPARE(flight.outputs().power, before.tetherSpeed * flight.outputs().tetherForce.norm());
    COMPARE_NEAR(flight.plant().state().tetherLength, state.tetherLength + 0.01 * now.tetherSpeed, 1e-12);
}

void tst_ClosedLoopFlight::real32SignalsAreRounded()
{
    const auto asFloat = [](double value) {
        const volatile float narrow = float(value);  // kept by every compiler
        return double(narrow);
    };
    ClosedLoopParameters parameters;
    parameters.precision = SignalPrecision::Real32;
    parameters.deadTime = 0;
    ClosedLoopFlight flight(parameters);
    flight.fly(10.0);
    const PlantOutputs &outputs = flight.outputs();
    for (double value : {outputs.position.x(), outputs.velocity.y(), outputs.bodyControlOrientation.z(),
                         outputs.angleOfAttack, outputs.tetherForce.z(), outputs.tetherLength, outputs.power,
                         outputs.energy, flight.autopilotOutputs().pitchSpeed, flight.autopilotOutputs().tetherSpeed,
                         flight.autopilotOutputs().yawSpeed})
        QVERIFY2(value == asFloat(value), qPrintable(QString::number(value, 'g', 17)));
    const double exact = flight.plant().state().position.x();
    QVERIFY(exact != asFloat(exact));
}

void tst_ClosedLoopFlight::resetRepeatsTheFlightBitForBit()
{
    ClosedLoopParameters parameters;
    parameters.wind.turbulenceIntensity = 0.15;
    parameters.deadTime = 3;
    ClosedLoopFlight flight(parameters);
    flight.fly(200.0);
    const PlantOutputs first = flight.outputs();
    const FlightReport firstReport = flight.report();
    flight.reset();
    QCOMPARE(flight.report().cycles, std::int64_t(0));
    flight.fly(200.0);
    QVERIFY(flight.outputs().position == first.position && flight.outputs().energy == first.energy);
    QVERIFY(flight.report().meanPower == firstReport.meanPower);
}

void tst_ClosedLoopFlight::badParametersAreNamed()
{
    QCOMPARE(ClosedLoopParameters().validate(), std::string());
    ClosedLoopParameters parameters;
    parameters.deadTime = 0;
    QCOMPARE(parameters.validate(), std::string());
    for (int cycles : {-1, 64}) {
        parameters.deadTime = cycles;
        VERIFY_CONTAINS(parameters.validate(),
                        "deadTime is " + std::to_string(cycles) + " cycles; choose a value from 0 to 63");
    }
    parameters = ClosedLoopParameters();
    parameters.wind.step = 0.02;
    VERIFY_CONTAINS(parameters.validate(), "step of the wind is 0.02 s; choose a value from 0.01 to 0.01 s");
    parameters = ClosedLoopParameters();
    parameters.gains.yawGain = -1.0;
    VERIFY_CONTAINS(parameters.validate(), "yawGain is -1");
}

QTEST_APPLESS_MAIN(tst_ClosedLoopFlight)
#include "tst_ClosedLoopFlight.moc"

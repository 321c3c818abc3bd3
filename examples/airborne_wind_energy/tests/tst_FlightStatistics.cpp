// SPDX-License-Identifier: Apache-2.0
#include "FlightStatistics.h"

#include "FlightPhase.h"
#include "Near.h"
#include "PlantParameters.h"

using namespace awe;

class tst_FlightStatistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void reportBeforeTheFirstSampleIsZero();
    void etaIsOneAtTheBestPower();
    void etaUsesTheNominalWindAndMeanEtaTheMeanCubedWind();
    void powersAreSplitByTheSignOfTheTetherSpeed();
    void warmUpIsLeftOutOfLongFlightsOnly();
    void energyIsLastMinusFirst();
    void pumpingCycleEndsWhenReelInBecomesPower();
    void recoveriesAreCountedOnce();
    void altitudeCountsAfterTheLaunchOnly();
    void minimumAltitudeUsesTheLaunchOfALaunchOnlyFlight();
    void reportContainsMeanAndMaximumSpeed();
    void crashIsTimed();
    void parametersFollowFromThePlant();
    void forceIsTheLargestOfAll();
    void groundContactIsACrash();
    void contactAboveTheGroundIsThatOfTheMast();
    void firstSwitchOffOfTheMachineIsTold();
    void unknownPhaseIsNotCounted();
    void resetClearsAllFigures();
    void badParameterIsNamed();

private:
    void add(int count);
    void enter(FlightPhase phase) { m_sample.flightPhase = static_cast<std::int8_t>(phase); }
    FlightStatistics m_statistics;
    FlightSample m_sample;
};

void tst_FlightStatistics::init()
{
    m_statistics = FlightStatistics();
    m_sample = FlightSample();
    m_sample.position = {80.0, 0.0, 40.0};
    m_sample.windVelocity = {5.0, 3.0, 0.0};
    m_sample.tetherSpeed = 2.0;
    enter(FlightPhase::ReelOut);
}

void tst_FlightStatistics::add(int count)
{
    for (int i = 0; i < count; ++i)
        m_statistics.step(m_sample);
}

void tst_FlightStatistics::reportBeforeTheFirstSampleIsZero()
{
    const FlightReport report = m_statistics.report();
    QCOMPARE(report.cycles, std::int64_t(0));
    QCOMPARE(report.eta, 0.0);
    QCOMPARE(report.meanPower, 0.0);
    QCOMPARE(report.minimumAltitude, 0.0);
    QVERIFY(!report.crashed);
}

void tst_FlightStatistics::etaIsOneAtTheBestPower()
{
    m_sample.power = 3091.46;
    add(100);
    COMPARE_NEAR(m_statistics.report().eta, 1.0, 1e-5);
    COMPARE_NEAR(m_statistics.report().etaPerMeanCubedWind, 1.0, 1e-5);
    COMPARE_NEAR(m_statistics.report().duration, 1.0, 1e-12);
}

void tst_FlightStatistics::etaUsesTheNominalWindAndMeanEtaTheMeanCubedWind()
{
    FlightStatisticsParameters parameters;
    parameters.nominalWindSpeed = 6.0;
    m_statistics = FlightStatistics(parameters);
    m_sample.power = 1000.0;
    m_sample.windVelocity = {4.0, 0.0, 0.0};
    add(50);
    m_sample.windVelocity = {0.0, 8.0, 0.0};
    add(50);
    const double perCube = 2.0 / 27.0 * 12.0 * parameters.aweCoefficient;
    COMPARE_NEAR(m_statistics.report().eta, 1000.0 / (perCube * 216.0), 1e-12);
    COMPARE_NEAR(m_statistics.report().etaPerMeanCubedWind, 1000.0 / (perCube * 0.5 * (64.0 + 512.0)), 1e-12);
    COMPARE_NEAR(m_statistics.report().meanWindSpeed, 6.0, 1e-12);
}

void tst_FlightStatistics::powersAreSplitByTheSignOfTheTetherSpeed()
{
    m_sample.power = 3000.0;
    add(60);
    m_sample.tetherSpeed = -4.0;
    m_sample.power = -500.0;
    add(30);
    m_sample.tetherSpeed = 0.0;
    m_sample.power = 0.0;
    add(10);
    const FlightReport report = m_statistics.report();
    COMPARE_NEAR(report.reelOutPower, 3000.0, 1e-9);
    COMPARE_NEAR(report.reelInPower, -500.0, 1e-9);
    COMPARE_NEAR(report.meanPower, 0.6 * 3000.0 - 0.3 * 500.0, 1e-9);
}

void tst_FlightStatistics::warmUpIsLeftOutOfLongFlightsOnly()
{
    m_sample.power = 1000.0;
    add(6000);  // 60 s
    m_sample.power = 2000.0;
    add(6000);
    COMPARE_NEAR(m_statistics.report().meanPower, 1500.0, 1e-9);  // 120 s: all
    add(1);
    COMPARE_NEAR(m_statistics.report().meanPower, 2000.0, 1e-9);  // longer: from 60 s on
    QCOMPARE(m_statistics.report().cycles, std::int64_t(12001));
}

void tst_FlightStatistics::energyIsLastMinusFirst()
{
    m_sample.energy = -100.0;
    add(1);
    m_sample.energy = 5000.0;
    add(1);
    QCOMPARE(m_statistics.report().energy, 5100.0);
}

void tst_FlightStatistics::pumpingCycleEndsWhenReelInBecomesPower()
{
    for (int i = 0; i < 3; ++i) {
        for (FlightPhase phase :
             {FlightPhase::Power, FlightPhase::ReelOut, FlightPhase::Retract, FlightPhase::ReelIn}) {
            enter(phase);
            add(5);
        }
    }
    QCOMPARE(m_statistics.report().pumpingCycles, 2);  // the third is not complete
    enter(FlightPhase::Power);
    add(1);
    QCOMPARE(m_statistics.report().pumpingCycles, 3);
}

void tst_FlightStatistics::recoveriesAreCountedOnce()
{
    enter(FlightPhase::Recover);
    add(100);
    enter(FlightPhase::Power);
    add(1);
    QCOMPARE(m_statistics.report().recoveries, 1);
    QCOMPARE(m_statistics.report().pumpingCycles, 0);
}

void tst_FlightStatistics::altitudeCountsAfterTheLaunchOnly()
{
    enter(FlightPhase::Launch);
    m_sample.position.z() = 18.0;
    add(10);
    enter(FlightPhase::Power);
    m_sample.position.z() = 40.0;
    add(10);
    QCOMPARE(m_statistics.report().minimumAltitude, 40.0);
    enter(FlightPhase::Launch);  // a second launch is part of the flight
    m_sample.position.z() = 30.0;
    add(1);
    QCOMPARE(m_statistics.report().minimumAltitude, 30.0);
}

void tst_FlightStatistics::minimumAltitudeUsesTheLaunchOfALaunchOnlyFlight()
{
    enter(FlightPhase::Launch);
    m_sample.position.z() = 18.0;
    add(10);
    QCOMPARE(m_statistics.report().minimumAltitude, 18.0);
}

void tst_FlightStatistics::reportContainsMeanAndMaximumSpeed()
{
    m_sample.velocity = {3.0, 4.0, 0.0};
    add(3);
    m_sample.velocity = {0.0, 0.0, -9.0};
    add(1);
    COMPARE_NEAR(m_statistics.report().meanSpeed, 6.0, 1e-12);
    QCOMPARE(m_statistics.report().maximumSpeed, 9.0);
}

void tst_FlightStatistics::crashIsTimed()
{
    add(250);
    m_sample.position.z() = 0.0;
    add(100);
    QVERIFY(m_statistics.report().crashed);
    COMPARE_NEAR(m_statistics.report().crashTime, 2.5, 1e-12);
}

void tst_FlightStatistics::parametersFollowFromThePlant()
{
    const FlightStatisticsParameters usual = FlightStatisticsParameters::of(PlantParameters());
    COMPARE_NEAR(usual.aweCoefficient, FlightStatisticsParameters().aweCoefficient, 1e-4);
    PlantParameters plant;
    plant.area = 20.0;
    plant.airDensity = 0.9;
    plant.dragFactor = 0.2;
    const FlightStatisticsParameters changed = FlightStatisticsParameters::of(plant);
    QCOMPARE(changed.area, 20.0);
    QCOMPARE(changed.airDensity, 0.9);
    QVERIFY(changed.aweCoefficient > 20.0 * usual.aweCoefficient);  // lift cubed / drag squared
}

void tst_FlightStatistics::forceIsTheLargestOfAll()
{
    m_sample.tetherForce = {-1200.0, 0.0, -1600.0};
    add(1);
    m_sample.tetherForce.setZero();
    add(1);
    COMPARE_NEAR(m_statistics.report().maximumTetherForce, 2000.0, 1e-9);
}

void tst_FlightStatistics::groundContactIsACrash()
{
    m_sample.position.z() = 0.0;
    add(1);
    m_sample.position.z() = 20.0;
    add(1);
    QVERIFY(m_statistics.report().crashed);
}

void tst_FlightStatistics::contactAboveTheGroundIsThatOfTheMast()
{
    m_sample.position.z() = 11.0;
    add(100);
    m_sample.crashed = true;
    add(10);
    const FlightReport report = m_statistics.report();
    QVERIFY(report.crashed && report.hitMast);
    COMPARE_NEAR(report.crashTime, 1.0, 1e-9);
    m_statistics.reset();
    m_sample.position.z() = -0.1;
    add(1);
    QVERIFY(m_statistics.report().crashed && !m_statistics.report().hitMast);
}

void tst_FlightStatistics::firstSwitchOffOfTheMachineIsTold()
{
    add(200);
    QVERIFY(!m_statistics.report().wasMachineOff);
    for (const bool isOff : {true, false, true}) {
        m_sample.isMachineOff = isOff;
        add(50);
    }
    QVERIFY(m_statistics.report().wasMachineOff);
    COMPARE_NEAR(m_statistics.report().machineOffTime, 2.0, 1e-9);
}

void tst_FlightStatistics::unknownPhaseIsNotCounted()
{
    m_sample.flightPhase = 77;
    add(10);
    QCOMPARE(m_statistics.report().recoveries, 0);
    QCOMPARE(m_statistics.report().pumpingCycles, 0);
}

void tst_FlightStatistics::resetClearsAllFigures()
{
    recoveriesAreCountedOnce();
    m_statistics.reset();
    reportBeforeTheFirstSampleIsZero();
    QCOMPARE(m_statistics.report().recoveries, 0);
}

void tst_FlightStatistics::badParameterIsNamed()
{
    FlightStatisticsParameters parameters;
    QCOMPARE(parameters.validate(), std::string());
    parameters.warmUp = 500.0;
    VERIFY_CONTAINS(parameters.validate(), "shortestFlight is 120 s; choose a value from 500");
    parameters = FlightStatisticsParameters();
    parameters.area = 0.0;
    VERIFY_CONTAINS(parameters.validate(), "area is 0 m²");
}

QTEST_APPLESS_MAIN(tst_FlightStatistics)
#include "tst_FlightStatistics.moc"

// SPDX-License-Identifier: Apache-2.0
#include "FlightStatistics.h"

#include "FlightPhase.h"
#include "PlantParameters.h"
#include "RangeCheck.h"

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

double mean(double sum, std::int64_t count)
{
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double ratio(double part, double whole)
{
    return whole > 0.0 ? part / whole : 0.0;
}

/// A phase of the pumping cycle, not of the mast.
bool isPumping(std::int8_t phase)
{
    return phase < static_cast<std::int8_t>(FlightPhase::Docked);
}

}  // namespace

std::string FlightStatisticsParameters::validate() const
{
    RangeCheck check;
    check.within("step", step, 1e-6, 1.0, "s");
    check.within("airDensity", airDensity, 1e-3, 100.0, "kg/m³");
    check.within("area", area, 1e-3, 1e6, "m²");
    check.within("aweCoefficient", aweCoefficient, 1e-3, 1e6, "");
    check.within("nominalWindSpeed", nominalWindSpeed, 0.0, 100.0, "m/s");
    check.within("warmUp", warmUp, 0.0, 1e6, "s");
    check.within("shortestFlight", shortestFlight, warmUp, 1e6, "s");
    return check.message();
}

FlightStatisticsParameters FlightStatisticsParameters::of(const PlantParameters &plant)
{
    FlightStatisticsParameters parameters;
    parameters.airDensity = plant.airDensity;
    parameters.area = plant.area;
    parameters.aweCoefficient = Aerodynamics::bestAngleOfAttack(plant.dragFactor).aweCoefficient;
    return parameters;
}

FlightStatistics::FlightStatistics(const FlightStatisticsParameters &parameters)
    : m_parameters(parameters)
{
}

void FlightStatistics::reset()
{
    *this = FlightStatistics(m_parameters);
}

void FlightStatistics::Sums::add(const FlightSample &sample, double windSpeedNow)
{
    ++count;
    power += sample.power;
    speed += sample.velocity.norm();
    windSpeed += windSpeedNow;
    cubedWind += windSpeedNow * windSpeedNow * windSpeedNow;
    if (sample.tetherSpeed > 0.0) {
        ++outCount;
        outPower += sample.power;
    } else if (sample.tetherSpeed < 0.0) {
        ++inCount;
        inPower += sample.power;
    }
}

void FlightStatistics::step(const FlightSample &sample)
{
    if (m_all.count == 0)
        m_firstEnergy = sample.energy;
    m_lastEnergy = sample.energy;
    m_last = {sample.electricalEnergy, sample.turbineEnergy};
    if (m_all.count == 0)
        m_first = m_last;
    if (m_afterWarmUp.count == 0)
        m_firstAfterWarmUp = m_last;
    const double windSpeed = sample.windVelocity.norm();
    if (static_cast<double>(m_all.count) * m_parameters.step >= m_parameters.warmUp)
        m_afterWarmUp.add(sample, windSpeed);
    m_all.add(sample, windSpeed);
    followPhase(sample.flightPhase);
    const double time = static_cast<double>(m_all.count - 1) * m_parameters.step;
    if ((sample.position.z() <= 0.0 || sample.crashed) && !m_crashed) {
        m_crashed = true;
        m_hitMast = sample.position.z() > 0.0;
        m_crashTime = time;
    }
    if (sample.isMachineOff && !m_wasMachineOff) {
        m_wasMachineOff = true;
        m_machineOffTime = time;
    }
    m_maximumSpeed = std::max(m_maximumSpeed, sample.velocity.norm());
    m_maximumPower = std::max(m_maximumPower, sample.power);
    m_maximumTetherForce = std::max(m_maximumTetherForce, sample.tetherForce.norm());
    double &altitude = altitudeIn(sample.flightPhase);
    altitude = std::min(altitude, sample.position.z());
    followMast(sample);
}

/// The flights from and to the mast are low on purpose.
double &FlightStatistics::altitudeIn(std::int8_t phase)
{
    return m_launched && isPumping(phase) ? m_minimumAltitude : m_launchAltitude;
}

void FlightStatistics::followMast(const FlightSample &sample)
{
    if (m_isDocked && !sample.isDocked)
        ++m_starts;
    if (sample.dockings > m_dockings)
        m_dockingSpeed = std::max(m_dockingSpeed, sample.dockingSpeed);
    m_isDocked = sample.isDocked;
    m_dockings = sample.dockings;
}

void FlightStatistics::followPhase(std::int8_t phase)
{
    const auto is = [](std::int8_t number, FlightPhase wanted) { return number == static_cast<std::int8_t>(wanted); };
    if (is(m_phase, FlightPhase::ReelIn) && is(phase, FlightPhase::Power))
        ++m_pumpingCycles;
    if (!is(m_phase, FlightPhase::Recover) && is(phase, FlightPhase::Recover))
        ++m_recoveries;
    m_launched = m_launched || (isPumping(phase) && !is(phase, FlightPhase::Launch));
    m_phase = phase;
}

double FlightStatistics::bestPower(double cubedWind) const
{
    return 2.0 / 27.0 * m_parameters.airDensity * m_parameters.area * cubedWind * m_parameters.aweCoefficient;
}

FlightReport FlightStatistics::report() const
{
    FlightReport report;
    report.cycles = m_all.count;
    report.duration = static_cast<double>(m_all.count) * m_parameters.step;
    report.energy = m_lastEnergy - m_firstEnergy;
    const Sums &window = report.duration > m_parameters.shortestFlight ? m_afterWarmUp : m_all;
    report.meanPower = mean(window.power, window.count);
    const Energies &begin = &window == &m_all ? m_first : m_firstAfterWarmUp;
    const double windowTime = static_cast<double>(window.count - 1) * m_parameters.step;
    if (window.count > 1) {
        report.electricalPower = (m_last.electrical - begin.electrical) / windowTime;
        report.turbinePower = (m_last.turbine - begin.turbine) / windowTime;
    }
    report.meanWindSpeed = mean(window.windSpeed, window.count);
    report.reelOutPower = mean(window.outPower, window.outCount);
    report.reelInPower = mean(window.inPower, window.inCount);
    const double windSpeed = m_parameters.nominalWindSpeed > 0.0 ? m_parameters.nominalWindSpeed : report.meanWindSpeed;
    report.eta = ratio(report.meanPower, bestPower(windSpeed * windSpeed * windSpeed));
    report.etaPerMeanCubedWind = ratio(report.meanPower, bestPower(mean(window.cubedWind, window.count)));
    report.pumpingCycles = m_pumpingCycles;
    report.recoveries = m_recoveries;
    report.meanSpeed = mean(window.speed, window.count);
    report.maximumSpeed = m_maximumSpeed;
    report.maximumPower = m_maximumPower;
    const double altitude = std::isfinite(m_minimumAltitude) ? m_minimumAltitude : m_launchAltitude;
    report.minimumAltitude = std::isfinite(altitude) ? altitude : 0.0;
    report.maximumTetherForce = m_maximumTetherForce;
    report.starts = m_starts;
    report.dockings = m_dockings;
    report.dockingSpeed = m_dockingSpeed;
    report.landed = m_starts > 0 && m_isDocked;
    report.crashed = m_crashed;
    report.hitMast = m_hitMast;
    report.crashTime = m_crashTime;
    report.wasMachineOff = m_wasMachineOff;
    report.machineOffTime = m_machineOffTime;
    return report;
}

}  // namespace awe

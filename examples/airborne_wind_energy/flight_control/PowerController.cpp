// SPDX-License-Identifier: Apache-2.0
#include "PowerController.h"

#include "AngleMath.h"

#include <cmath>

namespace awe {

namespace {

constexpr double cosineLoss = 1.2;  // wind speed / wind speed along the tether, averaged over an eight

}  // namespace

PowerController::PowerController(const AutopilotGains &gains)
    : m_gains(gains)
    , m_force(gains.forceFilterTime, gains.step)
{
}

void PowerController::reset()
{
    *this = PowerController(m_gains);
}

PowerController::References PowerController::step(const FlightMeasurements &measurements,
                                                  const FlightGeometry &geometry)
{
    m_force.step(measurements.tetherForce);
    m_phaseTime += m_gains.step;
    chooseNext(measurements, geometry);
    observeWind();

    References references;
    references.phase = m_phase;
    const bool onEight = m_phase == FlightPhase::Power || m_phase == FlightPhase::ReelOut;
    references.course = onEight ? Course::FigureEight : Course::Zenith;
    references.pitch = pitchReference(measurements, geometry);
    m_tetherSpeed = limitedTetherSpeed(wantedTetherSpeed(measurements, geometry), measurements.tetherForce);
    references.tetherSpeed = m_tetherSpeed;
    return references;
}

void PowerController::enter(FlightPhase phase)
{
    if (phase == FlightPhase::Power) {
        m_windSum = 0.0;
        m_windCount = 0.0;
    }
    m_phase = phase;
    m_phaseTime = 0.0;
    m_stallTime = 0.0;
}

void PowerController::chooseNext(const FlightMeasurements &measurements, const FlightGeometry &geometry)
{
    if (isStalled(measurements, geometry))
        return enter(FlightPhase::Recover);
    switch (m_phase) {
    case FlightPhase::Launch:
        if (geometry.tangentialSpeed > m_gains.launchSpeed || m_phaseTime >= m_gains.launchTime)
            enter(FlightPhase::Power);
        break;
    case FlightPhase::Power:
    case FlightPhase::ReelOut:
        if (m_gains.constantTether == 0.0 && measurements.tetherLength >= m_gains.longestTether) {
            m_windSpeed = m_windCount > 0.0 ? m_windSum / m_windCount : m_windSpeed;
            enter(FlightPhase::Retract);
        } else if (m_phase == FlightPhase::Power && m_phaseTime >= m_gains.powerTime) {
            enter(FlightPhase::ReelOut);
        }
        break;
    case FlightPhase::Retract:
        if (std::abs(geometry.heading) < m_gains.retractYaw || m_phaseTime >= m_gains.retractTime)
            enter(FlightPhase::ReelIn);
        break;
    case FlightPhase::ReelIn:
        if (measurements.tetherLength <= m_gains.shortestTether)
            enter(FlightPhase::Power);
        break;
    case FlightPhase::Recover:
        if (geometry.height > m_gains.recoverHeight && m_phaseTime >= m_gains.recoverTime
            && measurements.angleOfAttack < m_gains.recoverAngleOfAttack)
            enter(FlightPhase::Power);
        break;
    case FlightPhase::Docked:  // phases of the mast controller
    case FlightPhase::Ascend:
    case FlightPhase::Park:
    case FlightPhase::Descend:
        break;
    }
}

bool PowerController::isStalled(const FlightMeasurements &measurements, const FlightGeometry &geometry)
{
    const bool mayStall = m_phase == FlightPhase::ReelOut
        || ((m_phase == FlightPhase::Power || m_phase == FlightPhase::Launch) && m_phaseTime > m_gains.recoverGrace);
    const bool looksStalled
        = measurements.angleOfAttack > m_gains.recoverAngleOfAttack && geometry.tangentialSpeed < m_gains.recoverSpeed;
    m_stallTime = mayStall && looksStalled ? m_stallTime + m_gains.step : 0.0;
    return m_stallTime > m_gains.recoverDelay;
}

void PowerController::observeWind()
{
    if (m_phase != FlightPhase::ReelOut)
        return;
    m_windSum += cosineLoss * (m_tetherSpeed + 2.0 * std::sqrt(m_force.value() / m_gains.forceCoefficient));
    m_windCount += 1.0;
}

double PowerController::reelOutLaw() const
{
    return std::clamp(m_gains.reelOutFactor * std::sqrt(m_force.value() / m_gains.forceCoefficient), 0.0,
                      m_gains.fastestReelOut);
}

double PowerController::holdLaw(double tetherLength) const
{
    return std::clamp(m_gains.constantTetherGain * (m_gains.constantTether - tetherLength), -m_gains.fastestReelIn,
                      m_gains.fastestReelOut);
}

double PowerController::reelInLaw() const
{
    const double fastest = std::min(m_gains.fastestReelIn, m_gains.reelInWindFactor * m_windSpeed);
    const double stopForce = m_gains.reelInForceFactor * m_gains.forceCoefficient * m_windSpeed * m_windSpeed / 9.0;
    if (!(stopForce > 0.0))
        return 0.0;
    return std::clamp(-fastest * (1.0 - m_force.value() / stopForce), -fastest, m_gains.reelInPayOut);
}

double PowerController::wantedTetherSpeed(const FlightMeasurements &measurements, const FlightGeometry &geometry) const
{
    switch (m_phase) {
    case FlightPhase::Launch:
        return 0.0;
    case FlightPhase::Power:
    case FlightPhase::ReelOut:
        return m_gains.constantTether > 0.0 ? holdLaw(measurements.tetherLength) : reelOutLaw();
    case FlightPhase::Retract:
        return m_gains.retractFactor * reelOutLaw();
    case FlightPhase::ReelIn:
        return reelInLaw();
    case FlightPhase::Docked:  // phases of the mast controller
    case FlightPhase::Ascend:
    case FlightPhase::Park:
    case FlightPhase::Descend:
        return 0.0;
    case FlightPhase::Recover:
        break;
    }
    if (measurements.tetherLength <= m_gains.recoverShortestTether)
        return 0.0;
    return -std::clamp(m_gains.recoverWinchGain * (m_gains.recoverTargetHeight - geometry.height), 0.0,
                       m_gains.recoverReelIn);
}

double PowerController::limitedTetherSpeed(double wanted, double force)
{
    if (std::isfinite(m_gains.forceLimit)) {
        const double excess = force - m_gains.forceLimitMargin * m_gains.forceLimit;
        const double limiting = m_tetherSpeed + m_gains.forceLimitIntegral * m_gains.step * excess
            + m_gains.forceLimitProportional * (force - m_lastForce);
        wanted = std::clamp(limiting, wanted, std::max(wanted, m_gains.fastestReelOut));
        m_lastForce = force;
    }
    const double most = m_gains.winchAcceleration * m_gains.step;
    return std::clamp(wanted, m_tetherSpeed - most, m_tetherSpeed + most);
}

PitchReference PowerController::pitchReference(const FlightMeasurements &measurements,
                                               const FlightGeometry &geometry) const
{
    PitchReference reference;
    if (m_phase == FlightPhase::ReelIn) {
        reference.kind = PitchReference::Kind::AngleOfAttack;
        reference.angle = reelInAngleOfAttack(geometry);
    } else if (m_phase == FlightPhase::Recover) {
        reference.kind = PitchReference::Kind::AngleOfAttack;
        reference.angle = m_gains.recoverPitchTarget;
    } else {
        reference.angle = m_gains.reelOutPitch;
    }
    if (std::isfinite(m_gains.forceLimit) && measurements.pitchAngle > m_gains.lowestPitch)
        reference.fastestUp = m_gains.forceGuardGain * (m_gains.forceLimit - expectedForce(measurements.tetherForce));
    return reference;
}

double PowerController::expectedForce(double force) const
{
    return force + m_gains.forceGuardLead * (force - m_force.value());
}

double PowerController::reelInAngleOfAttack(const FlightGeometry &geometry) const
{
    const double tooHigh = geometry.elevation * degreesPerRadian - m_gains.reelInElevation;
    const double angle = m_gains.reelInAngleOfAttack - m_gains.reelInElevationGain * tooHigh
        - m_gains.reelInZenithDamping * geometry.zenithSpeed;
    return std::clamp(angle, m_gains.lowestReelInAngle, m_gains.highestReelInAngle);
}

}  // namespace awe

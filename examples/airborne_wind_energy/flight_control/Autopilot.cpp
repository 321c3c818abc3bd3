// SPDX-License-Identifier: Apache-2.0
#include "Autopilot.h"

#include "AngleMath.h"

#include <cmath>

namespace awe {

Autopilot::Autopilot(const AutopilotGains &gains)
    : m_gains(gains)
    , m_orientation(gains)
    , m_steering(gains)
    , m_course(gains)
    , m_power(gains)
    , m_mast(gains)
    , m_phase(gains.mast.isPresent ? FlightPhase::Docked : FlightPhase::Launch)
    , m_flightSpeed(gains.speedFilterTime, gains.step, gains.startSpeed)
    , m_windDirection(gains.windDirectionFilterTime, gains.step)
{
}

void Autopilot::reset()
{
    m_course.reset();
    m_power.reset();
    m_mast.reset();
    m_phase = m_gains.mast.isPresent ? FlightPhase::Docked : FlightPhase::Launch;
    m_tetherSpeed = 0.0;
    m_flightSpeed.reset(m_gains.startSpeed);
    m_windDirection.reset(0.0);
    m_hasWindDirection = false;
}

void Autopilot::filterWindDirection(double direction)
{
    if (!m_hasWindDirection)
        m_windDirection.reset(direction);
    m_hasWindDirection = true;
    const double filtered = m_windDirection.value();
    m_windDirection.step(filtered + wrapDegrees(direction - filtered));  // the short way round
    m_windDirection.reset(wrapDegrees(m_windDirection.value()));
}

bool Autopilot::isUsable(const FlightMeasurements &m)
{
    const double sum = m.position.sum() + m.velocity.sum() + m.pitchAngle + m.yawAngle + m.angleOfAttack
        + m.tetherLength + m.tetherForce + m.airspeed + m.windDirection
        + m.windVelocity.sum();  // not finite when one of them is not
    return std::isfinite(sum) && m.position.squaredNorm() > 0.0;
}

/// \return false if the pumping cycle is to be flown
bool Autopilot::flyAtMast(const FlightMeasurements &measurements, const FlightGeometry &geometry,
                          AutopilotOutputs *outputs)
{
    const MastController::References references = m_mast.step(measurements, geometry, m_power.phase(), m_tetherSpeed);
    if (references.beginsCycle) {
        m_power.reset();
        m_course.reset();
        m_flightSpeed.reset(m_gains.startSpeed);
    }
    if (references.fliesCycle)
        return false;
    outputs->phase = references.phase;
    if (references.phase == FlightPhase::Docked)
        return true;
    outputs->release = references.release;
    outputs->tetherSpeed = references.tetherSpeed;
    outputs->pitchSpeed = m_orientation.pitchSpeed(references.pitch, measurements);
    outputs->yawSpeed = m_orientation.yawSpeed(references.yaw, measurements.yawAngle, m_flightSpeed.value());
    return true;
}

void Autopilot::flyCycle(const FlightMeasurements &measurements, const FlightGeometry &geometry,
                         AutopilotOutputs *outputs)
{
    const PowerController::References references = m_power.step(measurements, geometry);
    double yawReference = 0.0;
    if (references.course == PowerController::Course::FigureEight) {
        const double speed = m_flightSpeed.step(geometry.tangentialSpeed);
        yawReference = m_course.figureEight(geometry, speed, m_orientation.yawSpeedLimit(speed));
    } else {
        yawReference = m_course.zenith(geometry);
    }
    outputs->phase = references.phase;
    outputs->tetherSpeed = references.tetherSpeed;
    outputs->pitchSpeed = m_orientation.pitchSpeed(references.pitch, measurements);
    outputs->yawSpeed = m_orientation.yawSpeed(yawReference, measurements.yawAngle, m_flightSpeed.value());
    if (references.course == PowerController::Course::FigureEight)
        outputs->turbineCoefficient = m_gains.turbineCoefficient;
}

AutopilotOutputs Autopilot::step(const FlightMeasurements &measurements)
{
    AutopilotOutputs outputs;
    outputs.phase = m_phase;
    if (!isUsable(measurements))
        return outputs;
    filterWindDirection(measurements.windDirection);
    const FlightGeometry geometry = FlightGeometry::from(measurements, m_windDirection.value() * radiansPerDegree);
    if (!m_gains.mast.isPresent || !flyAtMast(measurements, geometry, &outputs))
        flyCycle(measurements, geometry, &outputs);
    if (outputs.phase != FlightPhase::Docked)
        outputs.steering = m_steering.steering(outputs.yawSpeed, measurements, geometry);
    m_phase = outputs.phase;
    m_tetherSpeed = outputs.tetherSpeed;
    return outputs;
}

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#include "WinchDrive.h"

#include <algorithm>
#include <cmath>

namespace awe {

WinchDrive::WinchDrive(const WinchDriveParameters &parameters)
    : m_parameters(parameters)
    , m_silence(parameters.commandTimeout)
{
}

void WinchDrive::reset()
{
    *this = WinchDrive(m_parameters);
}

double WinchDrive::kineticEnergy() const
{
    return 0.5 * m_parameters.inertia() * m_speed * m_speed;
}

void WinchDrive::step(const WinchDriveInputs &inputs, double time)
{
    takeCommand(inputs, time);
    chooseState(inputs, time);
    const double share = std::exp(-time / m_parameters.currentLoopTime);
    const double target = isPowered() ? wantedCurrent(time) : 0.0;
    const double next = target + share * (m_current - target);
    const double mean = 0.5 * (m_current + next);
    m_current = next;
    moveShaft(mean, inputs.tetherForce, time);
}

// ---- states ----

void WinchDrive::takeCommand(const WinchDriveInputs &inputs, double time)
{
    if (!inputs.hasCommand) {
        m_silence += time;
        return;
    }
    m_silence = 0.0;
    m_isWanted = inputs.enable;
    m_setpoint = inputs.speedSetpoint;
}

void WinchDrive::chooseState(const WinchDriveInputs &inputs, double time)
{
    m_stateTime += time;
    const bool isStanding = std::abs(m_speed) < m_parameters.standstill;
    const bool isSilent = m_silence >= m_parameters.commandTimeout;
    if (inputs.emergencyStop)
        return leave(DriveState::Fault, DriveStop::EmergencyStop);
    if (std::abs(m_speed) > m_parameters.largestSpeed)
        return leave(DriveState::Fault, DriveStop::Overspeed);
    switch (m_state) {
    case DriveState::Disabled:
        if (m_isWanted && !isSilent)
            enter(DriveState::Enabled);
        break;
    case DriveState::Enabled:
        if (isSilent)
            leave(DriveState::QuickStop, DriveStop::CommandLost);
        else if (!m_isWanted)
            leave(DriveState::QuickStop, DriveStop::Command);
        break;
    case DriveState::QuickStop:
        if (isStanding || m_stateTime >= m_parameters.longestStop)
            enter(DriveState::Disabled);
        break;
    case DriveState::Fault:
        if (isStanding && !isSilent && !m_isWanted)
            enter(DriveState::Disabled);
        break;
    }
}

void WinchDrive::leave(DriveState state, DriveStop why)
{
    m_stop = why;
    if (m_state != state)
        enter(state);
}

void WinchDrive::enter(DriveState state)
{
    m_state = state;
    m_stateTime = 0.0;
    if (state == DriveState::Enabled) {
        m_reference = m_speed;
        m_integral = 0.0;
    }
}

// ---- control ----

double WinchDrive::wantedCurrent(double time)
{
    const WinchDriveParameters &p = m_parameters;
    const bool stops = m_state == DriveState::QuickStop;
    const double largestChange = (stops ? p.stopDeceleration : p.acceleration) * time;
    m_reference += std::clamp((stops ? 0.0 : m_setpoint) - m_reference, -largestChange, largestChange);

    const double error = m_reference - m_speed;
    const double gain = p.inertia() * p.speedBandwidth;
    const double wanted = (gain * error + m_integral) / p.torqueConstant;
    const double limited = std::clamp(wanted, -p.currentLimit, p.currentLimit);
    if (wanted == limited || (wanted > limited) != (error > 0.0))  // else it would wind up
        m_integral += gain / p.speedIntegralTime * error * time;
    return limited;
}

// ---- mechanics ----

/// Dry friction and brake, at the machine [N m]: against the motion, at most as much as stops it,
/// never so that they would push.
/// \param freeSpeed at the end of the step without them [rad/s] \param effectiveInertia what a
///         torque meets in this step [kg m^2/s]
double WinchDrive::frictionTorque(double freeSpeed, double effectiveInertia) const
{
    const double largest = m_parameters.dryFriction + (isBrakeClosed() ? m_parameters.brakeTorque : 0.0);
    const double stopping = -freeSpeed * effectiveInertia;
    return std::clamp(stopping, m_speed < 0.0 ? 0.0 : -largest, m_speed > 0.0 ? 0.0 : largest);
}

void WinchDrive::moveShaft(double current, double tetherForce, double time)
{
    const WinchDriveParameters &p = m_parameters;
    const double h = time;
    const double machineTorque = p.torqueConstant * current;
    const double tetherTorque = tetherForce * p.leverage();
    // J (w1 - w0) / h = torques - b (w0 + w1) / 2, solved for w1
    const double effectiveInertia = p.inertia() / h + 0.5 * p.viscousFriction;
    const double freeSpeed
        = ((p.inertia() / h - 0.5 * p.viscousFriction) * m_speed + machineTorque + tetherTorque) / effectiveInertia;
    const double friction = frictionTorque(freeSpeed, effectiveInertia);
    const double next = freeSpeed + friction / effectiveInertia;
    const double mean = 0.5 * (m_speed + next);
    m_speed = next;
    m_position += h * mean;

    const double copperLoss = 1.5 * p.windingResistance * current * current;
    const double converterLoss = isPowered() ? p.converterLoss : 0.0;
    const double frictionLoss = -friction * mean;
    const double brakeTorque = isBrakeClosed() ? p.brakeTorque : 0.0;
    const double brakeShare = brakeTorque > 0.0 ? brakeTorque / (brakeTorque + p.dryFriction) : 0.0;
    m_electricalPower = -machineTorque * mean - copperLoss - converterLoss;
    m_energies.tether += h * tetherTorque * mean;
    m_energies.electrical += h * m_electricalPower;
    m_energies.copper += h * copperLoss;
    m_energies.converter += h * converterLoss;
    m_energies.friction += h * (p.viscousFriction * mean * mean + (1.0 - brakeShare) * frictionLoss);
    m_energies.brake += h * brakeShare * frictionLoss;
}

}  // namespace awe

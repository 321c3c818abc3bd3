// SPDX-License-Identifier: Apache-2.0
#include "AutopilotNode.h"

#include "AngleMath.h"
#include "OptionSignals.h"

#include <algorithm>
#include <cmath>

namespace awe {

AutopilotNode::AutopilotNode(const AutopilotGains &gains, int extraDeadTime)
    : QPlcCompactSlaveNode(QStringLiteral("Autopilot"), ErrorZeroOrderHold)
    , m_autopilot(gains)
    , m_delayed(std::size_t(extraDeadTime))
{
    if (gains.turnRateFactor > 0.0)
        m_steering.emplace(this, steeringCommandSignal);
    if (gains.constantTether > 0.0)
        m_turbineCoefficient.emplace(this, turbineCoefficientSignal);
    if (gains.mast.isPresent) {
        m_docked.emplace(this, mastDockedSignal);
        m_request.emplace(this, flightRequestSignal);
        m_release.emplace(this, mastReleaseSignal);
    }
}

void AutopilotNode::reset()
{
    m_autopilot.reset();
    AutopilotOutputs atRest;
    atRest.phase = m_autopilot.phase();
    std::fill(m_delayed.begin(), m_delayed.end(), atRest);
    m_oldest = 0;
    send(atRest);
}

void AutopilotNode::step(const QPlcCycle &)
{
    AutopilotOutputs commands = m_autopilot.step(measurements());
    if (!m_delayed.empty()) {
        std::swap(commands, m_delayed[m_oldest]);
        m_oldest = (m_oldest + 1) % m_delayed.size();
    }
    send(commands);
}

FlightMeasurements AutopilotNode::measurements() const
{
    FlightMeasurements measured;
    measured.position = m_position;
    measured.velocity = m_velocity;
    measured.pitchAngle = m_controlOrientation.value().y();
    measured.yawAngle = m_controlOrientation.value().z();
    measured.angleOfAttack = m_angleOfAttack;
    measured.tetherLength = m_tetherLength;
    measured.tetherForce = m_tetherForce.value().norm();
    measured.airspeed = (m_windVelocity.value() - m_velocity.value()).norm();
    measured.windDirection = std::atan2(m_windVelocity.value().y(), m_windVelocity.value().x()) * degreesPerRadian;
    measured.windVelocity = m_windVelocity;
    if (m_docked)
        measured.isDocked = *m_docked;
    if (m_request)
        measured.request = *m_request;
    return measured;
}

void AutopilotNode::send(const AutopilotOutputs &commands)
{
    m_pitchSpeed = commands.pitchSpeed;
    m_yawSpeed = commands.yawSpeed;
    m_tetherSpeed = commands.tetherSpeed;
    m_phase = qint8(commands.phase);
    if (m_steering)
        *m_steering = commands.steering;
    if (m_turbineCoefficient)
        *m_turbineCoefficient = commands.turbineCoefficient;
    if (m_release)
        *m_release = commands.release;
}

}  // namespace awe

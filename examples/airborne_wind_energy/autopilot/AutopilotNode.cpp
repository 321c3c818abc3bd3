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
}

void AutopilotNode::reset()
{
    m_autopilot.reset();
    std::fill(m_delayed.begin(), m_delayed.end(), AutopilotOutputs());
    m_oldest = 0;
    send(AutopilotOutputs());
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
}

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#include "WinchDriveNode.h"

#include <algorithm>

namespace awe {

namespace {

constexpr quint64 longestGap = 200;  // steps that are made up for when this computer was busy with something else

}  // namespace

WinchDriveNode::WinchDriveNode(const WinchDriveParameters &parameters)
    : QPlcCompactSlaveNode(QStringLiteral("Drive"), SilentZeroOrderHold)
    , m_drive(parameters)
{
    setReceivesQuality(true);
}

void WinchDriveNode::reset()
{
    m_drive.reset();
    send();
}

void WinchDriveNode::step(const QPlcCycle &cycle)
{
    const WinchDriveInputs now = inputs();
    for (quint64 i = 0; i <= std::min(cycle.missedCycles(), longestGap); ++i)
        m_drive.step(now);
    send();
}

/// A command that is not of a fresh frame is none: the drive itself knows how long it bears that.
WinchDriveInputs WinchDriveNode::inputs() const
{
    WinchDriveInputs inputs;
    inputs.hasCommand = m_enable.quality().isGood() && m_speedSetpoint.quality().isGood();
    inputs.enable = m_enable;
    inputs.speedSetpoint = m_speedSetpoint;
    inputs.tetherForce = m_tetherForce;
    return inputs;
}

void WinchDriveNode::send()
{
    m_state = qint8(m_drive.state());
    m_stop = qint8(m_drive.stop());
    m_brake = m_drive.isBrakeClosed();
    m_speed = m_drive.speed();
    m_current = m_drive.current();
    m_position = m_drive.position();
    m_power = m_drive.electricalPower();
}

}  // namespace awe

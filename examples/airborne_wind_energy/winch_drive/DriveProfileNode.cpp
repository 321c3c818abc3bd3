// SPDX-License-Identifier: Apache-2.0
#include "DriveProfileNode.h"

namespace awe {

namespace {

constexpr qint8 cyclicVelocity = 9;  // mode of operation: the only one of this drive

}  // namespace

DriveProfileNode::DriveProfileNode()
    : QPlcCompactSlaveNode(QStringLiteral("Profile"), SilentZeroOrderHold)
{
    setReceivesQuality(true);
}

void DriveProfileNode::reset()
{
    m_profile.reset();
    m_statusword = m_profile.statusword();
    m_mode = cyclicVelocity;
    m_enable = false;
    m_speed = 0.0;
}

void DriveProfileNode::step(const QPlcCycle &)
{
    const bool isConnected = m_controlword.quality().isGood() && m_targetVelocity.quality().isGood();
    m_profile.step(isConnected, m_controlword, DriveState(m_driveState.value()));
    m_statusword = m_profile.statusword();
    m_enable = m_profile.isEnabled() && m_wantedMode == cyclicVelocity;
    m_speed = m_profile.isEnabled() ? m_targetVelocity.value() : 0.0;
}

}  // namespace awe

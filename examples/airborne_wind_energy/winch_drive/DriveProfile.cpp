// SPDX-License-Identifier: Apache-2.0
#include "DriveProfile.h"

namespace awe {

namespace {

// Bits of the controlword
constexpr std::uint16_t switchOn = 0x01;
constexpr std::uint16_t enableVoltage = 0x02;
constexpr std::uint16_t noQuickStop = 0x04;
constexpr std::uint16_t enableOperation = 0x08;
constexpr std::uint16_t faultReset = 0x80;

// Bits of the statusword beside those of the state
constexpr std::uint16_t voltageEnabled = 0x10;
constexpr std::uint16_t remote = 0x200;

}  // namespace

void DriveProfile::step(bool isConnected, std::uint16_t controlword, DriveState drive)
{
    if (drive == DriveState::Fault)
        m_state = Fault;
    else if (m_state == QuickStopActive && drive == DriveState::Disabled)
        m_state = SwitchOnDisabled;
    if (!isConnected)
        return stopQuickly();
    const bool isReset = (controlword & faultReset) && !(m_controlword & faultReset);
    m_controlword = controlword;
    if (m_state != Fault)
        takeCommand(controlword);
    else if (isReset && drive != DriveState::Fault)
        m_state = SwitchOnDisabled;
}

void DriveProfile::stopQuickly()
{
    if (m_state == OperationEnabled)
        m_state = QuickStopActive;
    else if (m_state == ReadyToSwitchOn || m_state == SwitchedOn)
        m_state = SwitchOnDisabled;
}

void DriveProfile::takeCommand(std::uint16_t controlword)
{
    if (!(controlword & enableVoltage)) {
        m_state = SwitchOnDisabled;
    } else if (!(controlword & noQuickStop)) {
        stopQuickly();
    } else if (!(controlword & switchOn)) {
        if (m_state != QuickStopActive)
            m_state = ReadyToSwitchOn;
    } else if (!(controlword & enableOperation)) {
        if (m_state == ReadyToSwitchOn || m_state == OperationEnabled)
            m_state = SwitchedOn;
    } else if (m_state == SwitchedOn) {
        m_state = OperationEnabled;
    }
}

std::uint16_t DriveProfile::statusword() const
{
    switch (m_state) {
    case SwitchOnDisabled:
        return 0x40 | remote;
    case ReadyToSwitchOn:
        return 0x21 | voltageEnabled | remote;
    case SwitchedOn:
        return 0x23 | voltageEnabled | remote;
    case OperationEnabled:
        return 0x27 | voltageEnabled | remote;
    case QuickStopActive:
        return 0x07 | voltageEnabled | remote;
    case Fault:
        break;
    }
    return 0x08 | remote;
}

}  // namespace awe

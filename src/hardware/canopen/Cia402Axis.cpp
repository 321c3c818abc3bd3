// SPDX-License-Identifier: Apache-2.0
#include "Cia402Axis.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

// Bits of the controlword, as commands of CiA 402.
constexpr quint16 wordDisableVoltage = 0x00;
constexpr quint16 wordQuickStop = 0x02;
constexpr quint16 wordShutdown = 0x06;
constexpr quint16 wordSwitchOn = 0x07;  // likewise: disable operation
constexpr quint16 wordEnableOperation = 0x0F;
constexpr quint16 bitHomingStart = 0x10;
constexpr quint16 bitFaultReset = 0x80;

// Bits of the statusword.
constexpr quint16 bitHomingAttained = 0x1000;
constexpr quint16 bitHomingError = 0x2000;

struct StatePattern
{
    quint16 mask;
    quint16 bits;
    AxisState state;
};

constexpr StatePattern statePatterns[] = {
    {0x4F, 0x00, AxisState::NotReady},         {0x4F, 0x40, AxisState::SwitchOnDisabled},
    {0x6F, 0x21, AxisState::ReadyToSwitchOn},  {0x6F, 0x23, AxisState::SwitchedOn},
    {0x6F, 0x27, AxisState::OperationEnabled}, {0x6F, 0x07, AxisState::QuickStopActive},
    {0x4F, 0x0F, AxisState::FaultReaction},    {0x4F, 0x08, AxisState::Fault},
};

}  // namespace

AxisState Cia402Axis::stateOf(quint16 statusword) noexcept
{
    for (const StatePattern &pattern : statePatterns) {
        if ((statusword & pattern.mask) == pattern.bits)
            return pattern.state;
    }
    return AxisState::Unknown;
}

QString Cia402Axis::stateText(AxisState state)
{
    switch (state) {
    case AxisState::NotReady:
        return QStringLiteral("Not ready to switch on");
    case AxisState::SwitchOnDisabled:
        return QStringLiteral("Switch on disabled");
    case AxisState::ReadyToSwitchOn:
        return QStringLiteral("Ready to switch on");
    case AxisState::SwitchedOn:
        return QStringLiteral("Switched on");
    case AxisState::OperationEnabled:
        return QStringLiteral("Operation enabled");
    case AxisState::QuickStopActive:
        return QStringLiteral("Quick stop active");
    case AxisState::FaultReaction:
        return QStringLiteral("Fault reaction active");
    case AxisState::Fault:
        return QStringLiteral("Fault");
    case AxisState::Unknown:
        break;
    }
    return QStringLiteral("unknown");
}

QString Cia402Axis::modeText(AxisMode mode)
{
    switch (mode) {
    case AxisMode::ProfileVelocity:
        return QStringLiteral("profile velocity");
    case AxisMode::ProfileTorque:
        return QStringLiteral("profile torque");
    case AxisMode::Homing:
        return QStringLiteral("homing");
    case AxisMode::SyncPosition:
        return QStringLiteral("cyclic synchronous position");
    case AxisMode::SyncVelocity:
        return QStringLiteral("cyclic synchronous velocity");
    case AxisMode::SyncTorque:
        return QStringLiteral("cyclic synchronous torque");
    case AxisMode::ProfilePosition:
    case AxisMode::None:
        break;
    }
    return {};
}

void Cia402Axis::reset() noexcept
{
    *this = Cia402Axis(m_limits);
}

AxisOutputs Cia402Axis::step(const AxisCommand &command, const AxisFeedback &feedback) noexcept
{
    m_state = feedback.isKnown ? stateOf(feedback.statusword) : AxisState::Unknown;
    m_isLimited = false;
    watch(command);
    watchHoming(command, feedback);
    AxisOutputs outputs;
    outputs.controlword = controlword(command);
    outputs.mode = command.mode;
    outputs.position = feedback.position;
    const bool follows = m_state == AxisState::OperationEnabled && isWanted(command) && feedback.mode == command.mode;
    if (follows) {
        outputs.velocity = limited(command.velocity, -m_limits.velocity, m_limits.velocity, 0.0);
        outputs.torque = limited(command.torque, -m_limits.torque, m_limits.torque, 0.0);
        if (command.mode == AxisMode::SyncPosition)
            outputs.position
                = limited(command.position, m_limits.lowestPosition, m_limits.highestPosition, feedback.position);
    }
    return outputs;
}

bool Cia402Axis::isWanted(const AxisCommand &command) const noexcept
{
    return !command.isSafe && command.enable && !command.quickStop && !m_isBlocked;
}

// What keeps the drive from being started again.
void Cia402Axis::watch(const AxisCommand &command) noexcept
{
    const bool isFaulty = m_state == AxisState::Fault || m_state == AxisState::FaultReaction;
    const bool hasLeft = m_wasEnabled && m_state != AxisState::OperationEnabled;
    if (isFaulty || command.quickStop || hasLeft)
        m_isBlocked = true;
    else if (!command.enable || command.isSafe)
        m_isBlocked = false;
    m_wasEnabled = m_state == AxisState::OperationEnabled && isWanted(command);
    if (command.faultReset && !m_wasReset && m_state == AxisState::Fault)
        m_isResetting = true;
    if (!command.faultReset || m_state != AxisState::Fault)
        m_isResetting = false;
    m_wasReset = command.faultReset;
}

void Cia402Axis::watchHoming(const AxisCommand &command, const AxisFeedback &feedback) noexcept
{
    const bool isReady = m_state == AxisState::OperationEnabled && isWanted(command) && command.mode == AxisMode::Homing
        && feedback.mode == AxisMode::Homing;
    const bool wasHoming = m_isHoming;
    if (!isReady || !command.home)
        m_isHoming = false;
    else if (!m_wasHome)
        m_isHoming = true;
    if (m_isHoming && !wasHoming)
        m_isHomed = false;
    else if (m_isHoming)
        m_isHomed = (feedback.statusword & bitHomingAttained) && !(feedback.statusword & bitHomingError);
    m_wasHome = isReady && command.home;
}

quint16 Cia402Axis::controlword(const AxisCommand &command) noexcept
{
    if (command.isSafe || command.quickStop || m_state == AxisState::Unknown)
        return quint16(wordQuickStop | (m_isResetting && !command.isSafe ? bitFaultReset : 0));
    const bool wanted = isWanted(command);
    switch (m_state) {
    case AxisState::SwitchOnDisabled:
        return wordShutdown;
    case AxisState::ReadyToSwitchOn:
        return wanted ? wordSwitchOn : wordShutdown;
    case AxisState::SwitchedOn:
        return wanted ? wordEnableOperation : wordShutdown;
    case AxisState::OperationEnabled:
        if (wanted)
            return quint16(wordEnableOperation | (m_isHoming ? bitHomingStart : 0));
        return m_isBlocked ? wordQuickStop : wordSwitchOn;
    case AxisState::QuickStopActive:
        return wanted ? wordEnableOperation : wordQuickStop;
    case AxisState::Fault:
        return m_isResetting ? bitFaultReset : wordDisableVoltage;
    case AxisState::NotReady:
    case AxisState::FaultReaction:
    case AxisState::Unknown:
        break;
    }
    return wordDisableVoltage;
}

double Cia402Axis::limited(double value, double low, double high, double otherwise) noexcept
{
    if (std::isnan(value)) {
        m_isLimited = true;
        return otherwise;
    }
    const double result = std::clamp(value, low, high);
    m_isLimited = m_isLimited || result != value;
    return result;
}

}  // namespace qplc

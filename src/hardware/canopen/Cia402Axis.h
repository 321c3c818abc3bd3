// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <limits>

namespace qplc {

/// States of a drive (CiA 402), numbered for the channel `state`.
enum class AxisState : quint8 {
    NotReady = 0,
    SwitchOnDisabled = 1,
    ReadyToSwitchOn = 2,
    SwitchedOn = 3,
    OperationEnabled = 4,
    QuickStopActive = 5,
    FaultReaction = 6,
    Fault = 7,
    Unknown = 8  ///< the drive has not told it, or tells bits that are no state
};

/// Modes of operation, numbered as in the drive (object 6060h).
enum class AxisMode : qint8 {
    None = 0,
    ProfilePosition = 1,
    ProfileVelocity = 3,
    ProfileTorque = 4,
    Homing = 6,
    SyncPosition = 8,
    SyncVelocity = 9,
    SyncTorque = 10
};

/// What the plant wants of a drive; targets in the units of the drive.
struct AxisCommand
{
    bool isSafe = true;  // the node does not compute: quick stop, and nothing else
    bool enable = false;
    bool quickStop = false;
    bool faultReset = false;  // a fault is reset when it becomes true
    bool home = false;        // homing begins when it becomes true (mode Homing)
    AxisMode mode = AxisMode::SyncVelocity;
    double velocity = 0.0;
    double torque = 0.0;
    double position = std::numeric_limits<double>::quiet_NaN();  // NaN: where it stands
};

/// What the drive told last.
struct AxisFeedback
{
    bool isKnown = false;
    quint16 statusword = 0;
    AxisMode mode = AxisMode::None;
    double position = 0.0;
};

/// What goes to the drive.
struct AxisOutputs
{
    quint16 controlword = 0;
    AxisMode mode = AxisMode::SyncVelocity;
    double velocity = 0.0;
    double torque = 0.0;
    double position = 0.0;
};

/// Limits of targets, in the units of the drive.
struct AxisLimits
{
    double velocity = std::numeric_limits<double>::infinity();  // of its amount
    double torque = std::numeric_limits<double>::infinity();    // of its amount
    double lowestPosition = -std::numeric_limits<double>::infinity();
    double highestPosition = std::numeric_limits<double>::infinity();
};

/// A drive with the profile CiA 402, as its master sees it: which controlword leads from the state
/// that the drive tells to the one that the plant wants. It knows no bus and no clock: one step for
/// each exchange of process data.
///
///     Switch on disabled -> Ready to switch on -> Switched on -> Operation enabled
///             ^                                                        |
///             |------------------ Quick stop active <------------------|
///           Fault <- Fault reaction <- any
///
/// The safe state is the quick stop: the drive brakes with its own ramp. A fault is reset on
/// request only. After a fault, a quick stop on request, or when the drive has left Operation
/// enabled by itself, `enable` has to be false once before the drive starts again. Targets count
/// only while the drive tells Operation enabled and the mode that was wanted; before, the position
/// is the actual one, speed and torque are 0. step() takes no memory.
class Cia402Axis
{
public:
    explicit Cia402Axis(const AxisLimits &limits = AxisLimits())
        : m_limits(limits)
    {
    }

    /// The state that a statusword tells.
    static AxisState stateOf(quint16 statusword) noexcept;
    static QString stateText(AxisState state);
    /// A word of a configuration: "cyclic synchronous velocity". Empty: no mode of this class.
    static QString modeText(AxisMode mode);

    /// Forgets the past: before the first step, and after the drive was lost.
    void reset() noexcept;
    AxisOutputs step(const AxisCommand &command, const AxisFeedback &feedback) noexcept;

    AxisState state() const noexcept { return m_state; }
    /// A target was cut to its limit in the last step, or is no number.
    bool isLimited() const noexcept { return m_isLimited; }
    /// Operation enabled was left, and waits for `enable` to be false once.
    bool isBlocked() const noexcept { return m_isBlocked; }
    /// Homing has ended well (bit 12 in mode Homing), since the last request for it.
    bool isHomed() const noexcept { return m_isHomed; }

private:
    quint16 controlword(const AxisCommand &command) noexcept;
    void watch(const AxisCommand &command) noexcept;
    void watchHoming(const AxisCommand &command, const AxisFeedback &feedback) noexcept;
    bool isWanted(const AxisCommand &command) const noexcept;
    double limited(double value, double low, double high, double otherwise) noexcept;

    AxisLimits m_limits;
    AxisState m_state = AxisState::Unknown;
    bool m_wasEnabled = false;  // Operation enabled, as wanted, in the last step
    bool m_isBlocked = false;
    bool m_wasReset = false;     // the request, in the last step
    bool m_isResetting = false;  // the bit that resets a fault is set
    bool m_wasHome = false;      // the request, in the last step
    bool m_isHoming = false;     // the bit that starts homing is set
    bool m_isHomed = false;
    bool m_isLimited = false;
};

}  // namespace qplc

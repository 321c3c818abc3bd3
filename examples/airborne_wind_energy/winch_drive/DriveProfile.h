// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WinchDrive.h"

#include <cstdint>

namespace awe {

/// The states of a drive as the standard CiA 402 has them, for a master on a CANopen bus: from
/// controlwords to what WinchDrive is told, and from its states to statuswords.
///
///     Switch on disabled -> Ready to switch on -> Switched on -> Operation enabled
///             ^                                                        |
///             |------------------ Quick stop active <------------------|
///           Fault <- any
///
/// Without fresh process data it makes a quick stop by itself: the master, its program or the bus
/// is lost. Behind the ramp it is in Switch on disabled (quick stop option code 2). step() takes no
/// memory. One thread at a time.
class DriveProfile
{
public:
    enum State { SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled, QuickStopActive, Fault };

    /// At Switch on disabled.
    void reset() { *this = DriveProfile(); }
    /// \param isConnected  \a controlword came in just now
    /// \param drive  what the drive does
    void step(bool isConnected, std::uint16_t controlword, DriveState drive);

    State state() const { return m_state; }
    std::uint16_t statusword() const;
    /// Whether the drive follows its setpoint.
    bool isEnabled() const { return m_state == OperationEnabled; }

private:
    void takeCommand(std::uint16_t controlword);
    void stopQuickly();

    State m_state = SwitchOnDisabled;
    std::uint16_t m_controlword = 0;
};

}  // namespace awe

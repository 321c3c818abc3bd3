// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WinchDriveParameters.h"

#include <cstdint>

namespace awe {

/// What the drive does. The numbers are those of its status frame.
enum class DriveState : std::int8_t {
    Disabled = 0,   ///< the power stage is off, the brake is closed
    Enabled = 1,    ///< the speed follows the setpoint
    QuickStop = 2,  ///< it comes to a standstill by itself, then Disabled
    Fault
    = 3  ///< the power stage is off, the brake is closed, until the cause is gone and the command is without `enable`
};

/// Why the drive is not, or was last not, Enabled. The numbers are those of its status frame.
enum class DriveStop : std::int8_t {
    Command = 0,        ///< it is told so
    CommandLost = 1,    ///< there was no command for longer than commandTimeout
    EmergencyStop = 2,  ///< the switch that is wired to the drive itself
    Overspeed = 3
};

/// What comes to the drive in one step.
struct WinchDriveInputs
{
    bool hasCommand = false;     // a fresh command is there; without one the last one holds until the time-out
    bool enable = false;         // of the command
    double speedSetpoint = 0.0;  // of the command, at the machine [rad/s], > 0 reels out
    double tetherForce = 0.0;    // that pulls at the drum [N], >= 0
    bool emergencyStop = false;
};

/// Where the energy went, since the beginning [J].
///
///     tether = electrical + copper + converter + friction + brake + what the speed holds
struct WinchEnergies
{
    double tether = 0.0;      // work of the tether on the drum, > 0 when reeling out
    double electrical = 0.0;  // that left the drive as electricity, > 0 when it generates
    double copper = 0.0;      // heat in the windings
    double converter = 0.0;   // heat in the power electronics
    double friction = 0.0;    // heat in bearings and gear
    double brake = 0.0;       // heat in the brake
};

/// The winch: a drum behind a gear, a permanent-magnet machine with current loop and speed
/// controller, a brake, and the states of a drive.
///
///     setpoint --> [ramp] --> (+) --> [PI, limit] --> [1 / (1 + s T_i)] -- i --> [k_t] --> (+) --+
///                              ^ -                                                       + ^ ^ - |
///                              |                  tether force --> [x r/n] ----------------+ |   |
///                              |                  friction, brake ---------------------------+   |
///                              |                                                                 |
///                              +------ speed --+------------------------------- [1 / (s J)] <----+
///                                              +--> [1/s] --> position
///
///     J w' = k_t i + F r/n - b w - (dry friction and brake, against the motion)
///     P_electrical = - k_t i w - 3/2 R i^2 - P_converter                      > 0 while it generates
///
/// This is the main electrical machine of the thesis (figure 2.8 and the text below it): its
/// current is tied to its torque and so to the tether force, its speed is measured and controlled,
/// its position tells the tether length.
///
/// A step uses the mean speed of its begin and its end for every power. So the work of all torques
/// is exactly what the kinetic energy has gained, and the balance of WinchEnergies holds to
/// rounding. Dry friction takes energy or nothing. step() takes no memory and never fails. One
/// thread at a time.
class WinchDrive
{
public:
    /// \pre parameters.validate() is empty
    explicit WinchDrive(const WinchDriveParameters &parameters = WinchDriveParameters());

    /// At rest, Disabled, all energies zero.
    void reset();
    /// Moves on by parameters().step seconds.
    void step(const WinchDriveInputs &inputs) { step(inputs, m_parameters.step); }
    /// Moves on by \a time [s], for a host with steps of its own.
    void step(const WinchDriveInputs &inputs, double time);

    const WinchDriveParameters &parameters() const { return m_parameters; }
    DriveState state() const { return m_state; }
    DriveStop stop() const { return m_stop; }
    bool isBrakeClosed() const { return m_state == DriveState::Disabled || m_state == DriveState::Fault; }
    double current() const { return m_current; }    // [A], > 0 drives out, < 0 while it holds or generates
    double speed() const { return m_speed; }        // of the machine [rad/s], > 0 reels out
    double position() const { return m_position; }  // of the machine [rad]
    double electricalPower() const { return m_electricalPower; }  // of the last step [W], > 0 while it generates
    double kineticEnergy() const;                                 // [J]
    const WinchEnergies &energies() const { return m_energies; }

private:
    bool isPowered() const { return m_state == DriveState::Enabled || m_state == DriveState::QuickStop; }
    void takeCommand(const WinchDriveInputs &inputs, double time);
    void chooseState(const WinchDriveInputs &inputs, double time);
    void enter(DriveState state);
    void leave(DriveState state, DriveStop why);
    double wantedCurrent(double time);
    double frictionTorque(double freeSpeed, double effectiveInertia) const;
    void moveShaft(double current, double tetherForce, double time);

    WinchDriveParameters m_parameters;
    DriveState m_state = DriveState::Disabled;
    DriveStop m_stop = DriveStop::Command;
    double m_stateTime = 0.0;  // since it was entered [s]
    double m_silence = 0.0;    // since the last command [s]
    bool m_isWanted = false;   // `enable` of the last command
    double m_setpoint = 0.0;   // of the last command [rad/s]
    double m_reference = 0.0;  // behind the ramp [rad/s]
    double m_integral = 0.0;   // of the speed controller [N m]
    double m_current = 0.0;    // [A]
    double m_speed = 0.0;      // [rad/s]
    double m_position = 0.0;   // [rad]
    double m_electricalPower = 0.0;
    WinchEnergies m_energies;
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Air.h"
#include "KitePlant.h"
#include "PlantOptions.h"
#include "WinchDrive.h"

#include <Eigen/Core>

#include <array>

namespace awe {

/// What an ExtendedPlant tells about one instant beside PlantOutputs.
struct PlantDetails
{
    double steering = 0.0;                               // u_s of the actuator [-]
    double tetherSpeed = 0.0;                            // of the drum [m/s], > 0 reels out
    Eigen::Vector3d windAt6m = Eigen::Vector3d::Zero();  // [3] [m/s]: where stations on the ground measure it
    double airDensity = 0.0;                             // at the wing [kg/m^3]
    double turbinePower = 0.0;                           // [W]
    double turbineEnergy = 0.0;                          // [J]
    double machineSpeed = 0.0;                           // [rad/s], > 0 reels out
    double machineCurrent = 0.0;                         // [A], < 0 while it holds or generates
    double machinePosition = 0.0;                        // [rad]
    double electricalPower = 0.0;                        // [W], > 0 while the winch generates
    WinchEnergies energies;                              // of the winch [J]
    bool isMachineOff = false;                           // overspeed switched it off; the brake holds the drum
    bool isDocked = false;                               // the wing hangs on the mast
    int dockings = 0;                                    // times it came back since reset()
    double dockingSpeed = 0.0;                           // |v| as it last came back [m/s]
};

/// The plant of the thesis, and what its outlook asks for: wind that grows with the height, a
/// tether with mass and drag, an electrical machine at the winch, a wing that the air turns, a
/// mast, and turbines on board. Each is one of the PlantOptions. Without any it is KitePlant, bit
/// for bit.
///
/// Points: 0 is the winch, N the wing; between them are the nodes of the tether, if it has
/// segments.
///
///     l0 = l_t / N,  mu = rho_T pi/4 d^2,  mass of a node mu l0, of the wing m + mu l0 / 2
///     segment from i to i+1: s = r(i+1) - r(i), L = |s|, e = s / L
///     T_i = max(0, EA / l0 (L - l0) + c min(1, (L - l0) / (1e-4 l0)) ((v(i+1) - v(i)) . e - v_t / N)) while L > l0
///     D_i = 1/2 rho_i c_dT d L |v_p| v_p, v_p: wind w_i - (v(i) + v(i+1)) / 2 across the segment;  half at each end
///     Straight tether:  c_d + c_dT d l_t / (4 A),  m + mu l_t / 3
///     Turbines:  F_tu = 1/2 rho A c_dt |v_r| v_r,  P_tu = 1/2 rho A c_dt |v_r|^3
///     Turn rate:  psi = -gamma_c, V = |v_r|
///         psi' = c_1 V u_s + c_2 / max(V, 5 m/s) sin(psi) cos(el) + az' sin(el)
///         u_s' = (u_cmd - u_s) / T_s, at most +-rate;  c_d (1 + 0.6 |u_s|)
///
/// With a mast (MastParameters) the flight begins docked, whatever the initial state says: the wing
/// hangs on the mast, no force acts, the tether is as long as the mast is far, and the drum stands.
/// Inputs of the wing do nothing until PlantInputs::release.
///
/// The damping of a segment begins with its stretch, so that the force is continuous. The axes of
/// the wing are those of the last segment: it hangs on the tether. The air (Air) is sampled once in
/// a cycle, at the middle of each segment. The machine (WinchDrive) moves on in parts of a cycle,
/// with the tension at its begin; between them all else is integrated as in KitePlant.
///
/// step() and the others take no memory and never fail. One thread at a time.
class ExtendedPlant
{
public:
    /// \param parameters  wing, ground, initial state, and the spring of the tether
    /// \pre parameters.validate() and options.validate() are empty
    explicit ExtendedPlant(const PlantParameters &parameters = PlantParameters(),
                           const PlantOptions &options = PlantOptions());

    /// Goes back to the initial state, exactly; also forgets a crash.
    void reset();

    /// What the sensors show at the present state when \a inputs act; changes nothing.
    PlantOutputs outputs(const PlantInputs &inputs) const;
    /// The same for what only this plant has.
    PlantDetails details(const PlantInputs &inputs) const;

    /// Moves the state one step of parameters().step seconds on.
    void step(const PlantInputs &inputs);

    const PlantParameters &parameters() const { return m_parameters; }
    const PlantOptions &options() const { return m_options; }

    /// Wing, tether and energy of the tether.
    PlantState state() const;

    /// l_t [m]
    double tetherLength() const { return m_isThesis ? m_thesis.state().tetherLength : single(m_state, TetherLength); }
    /// Of the winch, since reset() [J], > 0 when it has generated.
    double electricalEnergy() const { return m_machine.energies().electrical; }
    /// true since the machine was faster than its largest speed: its brake holds the drum until
    /// reset()
    bool isMachineOff() const { return m_machine.state() == DriveState::Fault; }
    /// Of the turbines, since reset() [J].
    double turbineEnergy() const { return single(m_state, TurbineEnergy); }

    /// true while the wing hangs on the mast
    bool isDocked() const { return m_isDocked; }
    /// How often the wing came back to the mast since reset().
    int dockings() const { return m_dockings; }
    /// |v| of the wing as it last came back [m/s]; 0 before.
    double dockingSpeed() const { return m_dockingSpeed; }

    /// true since the wing first was at z <= 0 or hit the mast, until reset()
    bool hasCrashed() const { return m_thesis.hasCrashed() || m_crashed; }

    /// N, 1 without segments
    int segmentCount() const { return m_points; }
    /// Where point \a point is [3] [m]. \param point  0 (the winch) ... segmentCount() (the wing)
    Eigen::Vector3d position(int point) const;
    /// [3] [m/s]
    Eigen::Vector3d velocity(int point) const;
    /// Puts a point where it is not by itself: a start with a tether that sags. \param point  1 ...
    /// segmentCount()
    void setPoint(int point, const Eigen::Vector3d &position, const Eigen::Vector3d &velocity);

private:
    // r and v of the points, then what has one value
    static constexpr int largestState = 6 * TetherParameters::mostSegments + 7;
    using State = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, largestState, 1>;
    enum Single { PitchAngle, YawAngle, Steering, TetherLength, AveragePower, Energy, TurbineEnergy, SingleCount };

    struct AirAt
    {
        Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // [m/s]
        double density = 0.0;                            // [kg/m^3]
    };
    struct Sample  // the air of a cycle
    {
        std::array<AirAt, TetherParameters::mostSegments> segments;
        AirAt wing;
    };
    struct Segment
    {
        Eigen::Vector3d along = Eigen::Vector3d::Zero();  // e
        double length = 0.0;                              // L [m]
    };
    struct Wing  // what acts on the wing
    {
        Aerodynamics::Airflow air;
        double airspeed = 0.0;                               // |v_r| [m/s]
        Eigen::Vector3d turbines = Eigen::Vector3d::Zero();  // F_tu [N]
        double turbinePower = 0.0;                           // [W]
    };

    double &single(State &state, Single which) const { return state[6 * m_points + which]; }
    double single(const State &state, Single which) const { return state[6 * m_points + which]; }
    Eigen::Vector3d pointIn(const State &state, int point) const;
    Eigen::Vector3d velocityIn(const State &state, int point) const;
    Sample sampled(const PlantInputs &inputs) const;
    AirAt airAt(double height, const PlantInputs &inputs) const;
    int substeps() const;
    Wing wing(const State &state, const AirAt &air, const PlantInputs &inputs) const;
    Segment segment(const State &state, int number) const;
    double tension(const State &state, int number, const Segment &segment, double tetherSpeed) const;
    double tensionNow(int number, double tetherSpeed) const;
    Eigen::Vector3d drag(const State &state, int number, const Segment &segment, const AirAt &air) const;
    void turn(const State &state, double airspeed, const PlantInputs &inputs, State *rates) const;
    State rates(const State &state, const Sample &air, double tetherSpeed, const PlantInputs &inputs) const;
    double drumSpeed(const PlantInputs &inputs) const;
    double driven(double time, int driveSteps, const PlantInputs &inputs);
    void noticeGround();
    void noticeMast(bool release);
    void crash();
    void hangOnMast();
    void waitOnMast();
    /// No force acts on the wing: it lies on the ground or hangs on the mast.
    bool isAtRest() const { return isHeld() || m_isDocked; }
    bool isHeld() const { return m_crashed && m_parameters.groundContact == GroundContact::Hold; }

    PlantParameters m_parameters;
    PlantOptions m_options;
    bool m_isThesis;
    int m_points;  // N
    KitePlant m_thesis;
    Aerodynamics m_aerodynamics;
    Air m_air;
    WinchDrive m_machine;
    State m_state;
    bool m_crashed = false;
    bool m_isDocked = false;
    int m_dockings = 0;
    double m_dockingSpeed = 0.0;  // [m/s]
};

}  // namespace awe

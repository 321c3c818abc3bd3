// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Aerodynamics.h"
#include "AutopilotGains.h"
#include "FlightGeometry.h"
#include "FlightMeasurements.h"
#include "FlightPhase.h"
#include "LowPass.h"
#include "OrientationController.h"

namespace awe {

/// Above the pumping cycle: starts the wing from a mast when the wind is strong enough, and lands
/// it there when it is not.
///
///     (Docked) --1--> (Ascend) --2--> (Park) --3--> (pumping cycle)
///        ^               |              |                  |
///        |               4              4                  5
///        |               v              v                  v
///        +------6------ (Descend) <-----+------------------+
///
///     1  fly: the wind is strong enough and no storm, docked for 60 s; or requested; never in a lull
///     2  l_t >= 100 m
///     3  10 s
///     4  land: requested, 3 s after the start; or the wind is too weak or a storm, 60 s after it; or a lull
///     5  the same; not in Retract and Recover, which turn the wing to the zenith first, unless in a lull
///     6  the mast says that it has the wing
///     7  (Docked, but the mast has no wing) --> Descend: also of an autopilot that begins in the air
///
///     wind    low pass 60 s of |w|: strong enough at 6.2 m/s, too weak at 5.6 m/s, a storm at 14.5 m/s, none at 13 m/s
///     lull    low pass 5 s of |w| below 3.5 m/s
///
/// The wing goes to the elevation of the mast in the azimuth of the wind. It is so light (0.5
/// kg/m^2) that a gust carries it along within a second. So the law does not wait until it has
/// drifted: it computes from the measured flow v_r at the wing which yaw angle and which angle of
/// attack give the force that is wanted. In e_r, e_u, e_a, with q = 1/2 rho A |v_r|^2:
///
///     v_a* = sat(-0.7 y, 2),               y = R cos(el) sin(phi)         a* = 2 (v_a* - v_a)
///     v_u* = sat(0.7 R (el* - el), 2)                                     u* = 2 (v_u* - v_u)
///     F_a = -q c_l v_rr / N sin(gamma) + q c_d v_ra / |v_r| = m a*                  --> gamma_ref, at most 60 deg
///     F_u = q c_l(alpha) v_rr / N cos(gamma) + q c_d(alpha) v_ru / |v_r| - m g cos(el) = m u*
///                                                                               --> alpha_ref, -5...18 deg
///     N = sqrt(v_rr^2 + v_ru^2)
///
/// With a slack tether nothing but lift holds the wing away from the winch. So alpha_ref, unless in
/// a lull, is at least that of
///
///     F_r = -q c_l v_ru / N cos(gamma) + q c_d v_rr / |v_r| - m g sin(el) = 20 N + 2 m (v_t - v . e_r)
///
/// Both equations hold at once only if the wing comes at the right speed along the tether: with L_u
/// and L_r, the lift that they ask for, v_rr = -v_ru L_u / L_r. Faster, and it is carried over the
/// mast. This is the fastest speed of the winch in the descent, unless in a lull.
///
/// The yaw angle moves the wing sideways only by the part v_rr of the flow along the tether: at 70
/// deg that is a third of the wind, at the zenith nothing. This is why the mast stands at 70 deg.
///
///     Ascend   v_t = sat(0.02 (F_f - 60 N), -1, 2)
///     Park     v_t = 0
///     Descend  v_t = -sat(0.5 + 0.094 (l_t - 14 m), 0.5, 4) sat((2500 N - F_f) / 1000 N, 1)
///                  sat((10 m/s - v_tan) / 4 m/s, 0, 1) - pull,  not below l_t = 11.2 m
///              pull = sat(5.5 m/s - |v_r|, 0, 6), less below 40 m: the winch makes the airspeed that the wind does not
///              v_t >= v . e_r + v_rr + v_ru L_u / L_r, unless in a lull
///
/// step() takes no memory and never fails. One thread at a time.
class MastController
{
public:
    struct References
    {
        bool fliesCycle = false;   // the power controller flies; what follows does not count
        bool beginsCycle = false;  // ... from the beginning
        FlightPhase phase = FlightPhase::Docked;
        double yaw = 0.0;  // gamma_ref [deg]
        PitchReference pitch;
        double tetherSpeed = 0.0;  // v_t [m/s]
        bool release = false;
    };

    explicit MastController(const AutopilotGains &gains);

    void reset();

    /// One cycle.
    /// \param cyclePhase   of the power controller, as it was in the last cycle
    /// \param tetherSpeed  v_t of the last cycle [m/s]
    References step(const FlightMeasurements &measurements, const FlightGeometry &geometry, FlightPhase cyclePhase,
                    double tetherSpeed);

    /// Mean wind [m/s] by which starts and landings are decided
    double windSpeed() const { return m_wind.value(); }

private:
    enum class Stage { Docked, Ascend, Park, Cycle, Descend };

    /// v_r along e_r, e_u, e_a
    struct Flow
    {
        double outwards = 0.0, zenithwards = 0.0, azimuthwards = 0.0;  // [m/s]
        double speed = 0.0;                                            // |v_r| [m/s]
        double outwardSpeed = 0.0;                                     // of the wing [m/s]
    };

    void enter(Stage stage);
    void observe(const FlightMeasurements &measurements);
    void chooseNext(const FlightMeasurements &measurements, FlightPhase cyclePhase);
    bool isLull() const { return m_shortWind.value() < m_mast.lullWind; }
    bool wantsToFly(FlightRequest request) const;
    bool wantsToLand(FlightRequest request) const;
    static Flow flowAt(const FlightMeasurements &measurements);
    double yawReference(const Flow &flow, const FlightGeometry &geometry, double angleOfAttack) const;
    double angleOfAttackReference(const Flow &flow, const FlightGeometry &geometry, double tetherSpeed) const;
    /// What moves the wing towards the elevation of the mast [N].
    double zenithForce(const FlightGeometry &geometry) const;
    /// What carries the wing and keeps the tether taut [N].
    double outwardForce(const FlightGeometry &geometry) const;
    /// Tether speed [m/s], < 0 reels in, beyond which the lift that keeps the tether taut carries
    /// the wing over the mast.
    double fastestFollow(const Flow &flow, const FlightGeometry &geometry, double angleOfAttack) const;
    Aerodynamics::Coefficients coefficientsAt(double angleOfAttack) const;
    /// The angle of attack at which lift c_l + drag c_d is \a force [deg]. \pre lift > 0
    double angleOfAttackFor(double force, double lift, double drag) const;
    double tetherSpeed(const Flow &flow, const FlightGeometry &geometry, double tetherLength) const;
    double dynamicForce(const Flow &flow) const;

    AutopilotGains m_gains;
    MastGains m_mast;
    Aerodynamics m_aerodynamics;
    LowPass m_wind, m_shortWind;  // [m/s]
    LowPass m_force;              // [N]
    bool m_hasMeasured = false;
    Stage m_stage = Stage::Docked;
    double m_stageTime = 0.0;   // [s]
    double m_flightTime = 0.0;  // since the start [s]
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "FlightGeometry.h"
#include "FlightMeasurements.h"
#include "FlightPhase.h"
#include "LowPass.h"
#include "OrientationController.h"

namespace awe {

/// Outermost loop: plans the pumping cycle and runs the winch.
///
///     (Launch) --1--> (Power) --2--> (ReelOut) --3--> (Retract) --4--> (ReelIn)
///         |           |  ^  ^            |                                |
///         |           |  |  +------------|---------------5----------------+
///         +-----6-----+--|-------6-------+
///                     |  |
///                     v  7
///                   (Recover)
///
///     1  v_tan > 8 m/s or 5 s         3  l_t >= 200 m (from Power too)       5  l_t <= 100 m
///     2  4 s                          4  |gamma_c| < 80 deg or 6 s           7  z > 28 m, 1.5 s and alpha < 35 deg
///     6  lull: alpha > 35 deg and v_tan < 7 m/s for 0.6 s; in Launch and Power not before 2.5 s
///
///     Power, ReelOut   course eight,  beta_ref = 9 deg,  v_t = kappa sqrt(F_f / C)          0...10 m/s
///     Launch           course zenith, beta_ref = 9 deg,  v_t = 0
///     Retract          course zenith, beta_ref = 9 deg,  v_t = 0.3 kappa sqrt(F_f / C)
///     ReelIn           course zenith, alpha_ref = sat(-4 + 0.5 (el_in - el) - 1.7 v_u, -20, 15),
///                      v_t = sat(-v_in (1 - F_f / F_0), -v_in, 3), v_in = min(10, 1.3 v_w), F_0 =
///                      0.3 C v_w^2 / 9
///     Recover          course zenith, alpha_ref = 13 deg,  v_t = -sat(0.5 (35 - z), 0, 8) while l_t > 50 m
///
/// The reel-out law needs no wind sensor: the best force is F = C / 4 (v_w - v_t)^2 with C = 2 rho
/// A c_AWE, so v_t = sqrt(F / C) is a third of the wind speed (Loyd's optimum); kappa = 0.75 is
/// better over the whole cycle because it makes reeling in a smaller share. The same relation
/// turned round estimates the wind speed for the reel-in: v_w = 1.2 mean(v_t + 2 sqrt(F_f / C))
/// over the last reel-out; 1.2 stands for the cosine losses of the eight.
///
/// The tether speed changes by 5 m/s^2 at most. With an upper force limit F_max two more laws act
/// in every phase:
///
///     winch   v_t = max(law, v_t(k-1) + 0.02 h (F - 0.95 F_max) + 0.003 (F - F(k-1)))        gives way, at most 10 m/s
///     pitch   pitchSpeed <= 0.04 (F_max - F_x),  F_x = F + (F - F_f)        F_x: the force a quarter of a second ahead
///
/// The winch keeps the mean, the pitch stops the nose from coming up too fast after the reel-in and
/// takes lift away where the winch is not quick enough. Measured: 4...12 m/s without turbulence,
/// limit 4 kN, peaks below 4.0 kN. A limit costs power: with F_max the reel-out speed is v_w - 2
/// sqrt(F_max / C) and the mean of a cycle stays below F_max / (1 / v_out + 1 / v_in), whatever the
/// flight; at 12 m/s, 4 kN and 10 m/s reel-in that is eta = 0.55 before any loss.
class PowerController
{
public:
    enum class Course { FigureEight, Zenith };

    struct References
    {
        FlightPhase phase = FlightPhase::Launch;
        Course course = Course::Zenith;
        PitchReference pitch;
        double tetherSpeed = 0.0;  // v_t [m/s]
    };

    explicit PowerController(const AutopilotGains &gains);

    void reset();

    /// One cycle.
    References step(const FlightMeasurements &measurements, const FlightGeometry &geometry);

    FlightPhase phase() const { return m_phase; }

    /// v_w of the last reel-out [m/s]; 0 before the first
    double windSpeedEstimate() const { return m_windSpeed; }

    /// F_f [N]
    double filteredForce() const { return m_force.value(); }

private:
    void enter(FlightPhase phase);
    void chooseNext(const FlightMeasurements &measurements, const FlightGeometry &geometry);
    bool isStalled(const FlightMeasurements &measurements, const FlightGeometry &geometry);
    double reelOutLaw() const;
    double holdLaw(double tetherLength) const;
    double reelInLaw() const;
    double wantedTetherSpeed(const FlightMeasurements &measurements, const FlightGeometry &geometry) const;
    PitchReference pitchReference(const FlightMeasurements &measurements, const FlightGeometry &geometry) const;
    double expectedForce(double force) const;
    double reelInAngleOfAttack(const FlightGeometry &geometry) const;
    double limitedTetherSpeed(double wanted, double force);
    void observeWind();

    AutopilotGains m_gains;
    LowPass m_force;
    FlightPhase m_phase = FlightPhase::Launch;
    double m_phaseTime = 0.0;    // since the phase began [s]
    double m_stallTime = 0.0;    // [s]
    double m_tetherSpeed = 0.0;  // last v_t [m/s]
    double m_lastForce = 0.0;    // [N]
    double m_windSum = 0.0;      // [m/s]
    double m_windCount = 0.0;
    double m_windSpeed = 0.0;  // [m/s]
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Aerodynamics.h"
#include "PlantInputs.h"
#include "PlantOutputs.h"
#include "PlantParameters.h"
#include "PlantState.h"
#include "WingFrame.h"

namespace awe {

/// A lift airborne wind energy plant: a point mass with wing aerodynamics on a massless spring
/// tether.
///
///     pitchSpeed --> [1/s] -- beta_c ---> +--------------+
///     yawSpeed ----> [1/s] -- gamma_c --> | aerodynamics | -- F_ae --+
///     wind --> (+) -- v_r --------------> +--------------+           v
///               ^ -                           gravity -- F_g ----> (sum) --> [1/m] --> [1/s] -- v --> [1/s] -- r
///               v                         +--------------+           ^
///     tetherSpeed --> [1/s] -- l_t -----> |    tether    | -- F_t ---+
///                                   r --> +--------------+
///
/// Frames. Earth: x east, y north, z up. At the wing: e_r away from the ground station, e_u along
/// the sphere to the zenith, e_a to larger azimuth. Body: x_b to the tail, y_b along the span, z_b
/// out of the top side; it is the earth frame turned by Rz(azimuth) Ry(90 deg - elevation)
/// Rz(gamma_c) Ry(beta_c) (thesis, equation 4.2). With beta_c = gamma_c = 0 the nose looks to the
/// zenith and the bottom to the ground station.
///
///     R = |r|,  v_r = w - v,  alpha = asin(v_r . z_b / |v_r|)                       (thesis, equations 4.5 and 4.6)
///     F_ae as in Aerodynamics,  F_g = (0, 0, -m g)                                     (equations 4.4 and 4.1)
///     F_t = -max(0, c_t (R - l_t) + d_t (R' - v_t)) e_r while R > l_t, else 0          (equation 4.11; d_t is ours)
///     r' = v,  v' = (F_ae + F_t + F_g) / m,  beta_c' = pitchSpeed,  gamma_c' = yawSpeed,  l_t' = v_t
///     P = v_t |F_t|,  averagePower' = (P - averagePower) / T,  energy' = P             (section 4.1.4)
///
/// Integrated with the classical Runge-Kutta method of order 4 and a fixed step, inputs held.
///
///     KitePlant plant(parameters);                     // parameters.validate() was empty
///     const PlantOutputs y = plant.outputs(u);     // y(k) from x(k) and u(k)
///     plant.step(u);                               // x(k) -> x(k+1)
///
/// outputs() and step() take no memory and never fail. One thread at a time.
class KitePlant
{
public:
    /// \pre parameters.validate() is empty
    explicit KitePlant(const PlantParameters &parameters = PlantParameters());

    /// Goes back to the initial state, exactly; also forgets a crash.
    void reset();

    /// What the sensors show at the present state when \a inputs act; changes nothing.
    PlantOutputs outputs(const PlantInputs &inputs) const;

    /// Moves the state one step of parameters().step seconds on.
    void step(const PlantInputs &inputs);

    const PlantParameters &parameters() const { return m_parameters; }
    const PlantState &state() const { return m_state; }

    /// true since the wing first was at z <= 0, until reset()
    bool hasCrashed() const { return m_crashed; }

private:
    struct Forces
    {
        Aerodynamics::Airflow air;
        Eigen::Vector3d tether;  // F_t [N]
        double tetherTension;    // |F_t| [N]
    };
    struct Rates  // time derivatives of the states that are not a mere ramp
    {
        Eigen::Vector3d velocity, acceleration;
        double averagePower, power;
    };

    Forces forces(const PlantState &state, const Attitude &attitude, const PlantInputs &inputs) const;
    Rates rates(const PlantState &state, const Attitude &attitude, const PlantInputs &inputs) const;
    PlantState moved(const Rates &rates, double time, const PlantInputs &inputs) const;
    double tetherTension(const PlantState &state, double distance, double tetherSpeed) const;
    void noticeGround();
    bool isHeld() const { return m_crashed && m_parameters.groundContact == GroundContact::Hold; }

    PlantParameters m_parameters;
    Aerodynamics m_aerodynamics;
    PlantState m_state;
    Attitude m_attitude;  // belongs to m_state, kept because the end of one step is the start of the next
    bool m_crashed = false;
};

}  // namespace awe

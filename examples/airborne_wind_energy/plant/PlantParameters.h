// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Aerodynamics.h"
#include "PlantState.h"

#include <string>

namespace awe {

/// What happens when the wing reaches the ground.
enum class GroundContact {
    Ignore,  ///< the wing flies on below zero height: the reference model has no ground
    Hold     ///< the wing stays where it came down; no force acts and no power flows any more
};

/// Constants of the plant and where it starts. The values here are those of the thesis; its text
/// leaves the initial state open, so the wing starts at rest, 100 m from the ground station, 30 deg
/// high, downwind of the wind (5, 3, 0).
struct PlantParameters
{
    double mass = 5.0;                // m [kg]
    double area = 10.0;               // A [m^2]
    double airDensity = 1.2;          // rho [kg/m^3]
    double tetherStiffness = 1000.0;  // c_t [N/m]
    double tetherDamping = 0.0;       // d_t [N s/m], acts only while the tether is taut
    double gravity = 9.81;            // g [m/s^2]
    double averagePowerTime = 180.0;  // time constant of the average power [s]
    double step = 0.010;              // h of the Runge-Kutta method [s]
    double dragFactor = 1.0;          // multiplies c_d [-]
    AngleOfAttackRange angleOfAttackRange = AngleOfAttackRange::Folded;
    GroundContact groundContact = GroundContact::Ignore;
    PlantState initialState = defaultInitialState();

    /// Calls visit(name, value, smallest, largest, unit) for each constant of \a parameters that a
    /// file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("mass", parameters.mass, 1e-3, 1e6, "kg");
        visit("area", parameters.area, 1e-3, 1e6, "m²");
        visit("airDensity", parameters.airDensity, 1e-3, 100.0, "kg/m³");
        visit("tetherStiffness", parameters.tetherStiffness, 0.0, 1e9, "N/m");
        visit("tetherDamping", parameters.tetherDamping, 0.0, 1e9, "N s/m");
        visit("dragFactor", parameters.dragFactor, 1e-3, 1e3, "");
        visit("gravity", parameters.gravity, 0.0, 100.0, "m/s²");
        visit("averagePowerTime", parameters.averagePowerTime, 1e-3, 1e9, "s");
    }

    static PlantState defaultInitialState();

    /// A state at rest on a taut, unstretched tether, nose to the zenith, beta_c = 9 deg.
    /// \param elevation  above the horizon [deg], -90...90
    /// \param azimuth    from the x axis (east) towards the y axis (north) [deg]
    /// \param distance   from the ground station [m], > 0
    static PlantState stateAtRest(double elevation, double azimuth, double distance);

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe

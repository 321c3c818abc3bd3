// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace awe {

/// How a command turns the wing.
enum class SteeringKind {
    Kinematic,  ///< the yaw speed itself is the command (thesis, section 4.1.3)
    TurnRate    ///< an actuator pulls at the wing, and the air turns it
};

/// The steering with its actuator. c_1 and c_2 were identified for the V3 kite at a depower of 0.25
/// (SimpleKiteControllers.jl); the actuator is our own choice: with the 0.2 1/s of that kite's
/// control pod this small wing cannot be flown.
struct SteeringParameters
{
    SteeringKind kind = SteeringKind::Kinematic;
    double turnRateFactor = 0.31;  // c_1: turn per metre flown at full steering [rad/m]
    double weightFactor = 0.076;   // c_2: the weight turns the nose down [m/s^2]
    double actuatorTime = 0.05;    // T_s [s]
    double actuatorRate = 2.0;     // largest |u_s'| [1/s]
    double steeringDrag = 0.6;     // c_d grows by the factor 1 + this |u_s| [-]

    /// Calls visit(name, value, smallest, largest, unit) for each constant that a file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("turnRateFactor", parameters.turnRateFactor, 1e-3, 100.0, "rad/m");
        visit("weightFactor", parameters.weightFactor, 0.0, 100.0, "m/s²");
        visit("actuatorTime", parameters.actuatorTime, 0.01, 10.0, "s");
        visit("actuatorRate", parameters.actuatorRate, 0.01, 100.0, "1/s");
        visit("steeringDrag", parameters.steeringDrag, 0.0, 10.0, "");
    }

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe

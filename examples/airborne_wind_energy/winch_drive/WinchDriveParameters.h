// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace awe {

/// Constants of the winch with its drive. "At the machine" means: on the fast side of the gear.
///
/// The values are our own choice, of the size that servo machines of 15 ... 20 kW have; they are of
/// no certain product. They fit the kite of this example: 1.6 kN at 1.9 m/s in the mean, peaks of
/// some kN (thesis, sections 2.1.4 and 4.2), reeling in at 4 m/s and more.
struct WinchDriveParameters
{
    // Drum and gear
    double drumRadius = 0.15;       // r [m]
    double gearRatio = 5.0;         // n, turns of the machine for a turn of the drum [1]
    double drumInertia = 0.6;       // with the tether on it, at the drum [kg m^2]
    double rotorInertia = 0.03;     // machine and gear, at the machine [kg m^2]
    double dryFriction = 1.0;       // at the machine [N m]
    double viscousFriction = 0.01;  // at the machine [N m s/rad]
    double brakeTorque = 300.0;     // of the closed brake, at the machine [N m]: holds 10 kN

    // Machine and power electronics
    double torqueConstant = 1.5;      // k_t [N m/A], A: amplitude of the phase current
    double windingResistance = 0.12;  // R of one phase [ohm]
    double currentLimit = 150.0;      // [A]: 7.5 kN
    double currentLoopTime = 0.002;   // T_i, time constant of the closed current loop [s]
    double converterLoss = 60.0;      // while the power stage is on [W]

    // Speed controller
    double speedBandwidth = 100.0;    // [rad/s]: K_p = J x this
    double speedIntegralTime = 0.04;  // T_n [s]
    double acceleration = 200.0;      // of the reference, at the machine [rad/s^2]: 6 m/s^2
    double stopDeceleration = 600.0;  // of the reference in a quick stop, at the machine [rad/s^2]: 18 m/s^2
    double longestStop = 1.0;         // after this time of a quick stop the brake closes at any speed [s]
    double standstill = 1.0;          // below this speed the brake closes without harm [rad/s]
    double largestSpeed = 450.0;      // above this speed it is a fault [rad/s]: 13.5 m/s
    double commandTimeout = 0.1;      // without a command for longer: quick stop [s]
    double step = 0.001;              // h [s]

    /// Calls visit(name, value, smallest, largest, unit) for each constant that a file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("drumRadius", parameters.drumRadius, 1e-3, 100.0, "m");
        visit("gearRatio", parameters.gearRatio, 1e-2, 1e4, "");
        visit("drumInertia", parameters.drumInertia, 0.0, 1e6, "kg m²");
        visit("rotorInertia", parameters.rotorInertia, 1e-6, 1e6, "kg m²");
        visit("dryFriction", parameters.dryFriction, 0.0, 1e6, "N m");
        visit("viscousFriction", parameters.viscousFriction, 0.0, 1e6, "N m s/rad");
        visit("torqueConstant", parameters.torqueConstant, 1e-3, 1e3, "N m/A");
        visit("windingResistance", parameters.windingResistance, 0.0, 1e3, "ohm");
        visit("currentLimit", parameters.currentLimit, 1e-3, 1e5, "A");
        visit("currentLoopTime", parameters.currentLoopTime, 1e-5, 1.0, "s");
        visit("converterLoss", parameters.converterLoss, 0.0, 1e6, "W");
        visit("speedBandwidth", parameters.speedBandwidth, 1e-2, 1e4, "rad/s");
        visit("speedIntegralTime", parameters.speedIntegralTime, 1e-4, 1e3, "s");
        visit("acceleration", parameters.acceleration, 1e-3, 1e6, "rad/s²");
        visit("largestSpeed", parameters.largestSpeed, 1e-3, 1e5, "rad/s");
    }

    /// J, all that turns, at the machine [kg m^2]
    double inertia() const { return rotorInertia + drumInertia / (gearRatio * gearRatio); }
    /// Tether that one radian of the machine reels out [m/rad]
    double leverage() const { return drumRadius / gearRatio; }

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe

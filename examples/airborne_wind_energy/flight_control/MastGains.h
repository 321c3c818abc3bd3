// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantParameters.h"

namespace awe {

class RangeCheck;

/// What can be set on the MastController. The values here fit the wing of the thesis.
struct MastGains
{
    bool isPresent = false;   // false: the autopilot only flies the pumping cycle
    double distance = 12.0;   // of the mast's top from the winch [m]
    double elevation = 70.0;  // of the mast's top, and of a parked wing [deg]

    // When to fly
    double startWind = 6.2;         // mean wind that is strong enough to start [m/s]
    double landWind = 5.6;          // mean wind that is too weak to stay [m/s]
    double stormStartWind = 13.0;   // mean wind that is too strong to start [m/s]
    double stormLandWind = 14.5;    // mean wind that is too strong to stay [m/s]
    double lullWind = 3.5;          // short mean that ends every flight at once [m/s]
    double windFilterTime = 60.0;   // of the mean wind [s]
    double lullFilterTime = 5.0;    // of the short mean [s]
    double leastDockedTime = 60.0;  // before a start without a request [s]
    double leastFlightTime = 60.0;  // before a landing because of the mean wind [s]
    double startTime = 3.0;         // before any landing: then the wing has left the mast [s]

    // The wing, as the controller knows it
    double mass = PlantParameters().mass;           // [kg]
    double area = PlantParameters().area;           // [m^2]
    double density = PlantParameters().airDensity;  // of the air [kg/m^3]
    double gravity = PlantParameters().gravity;     // [m/s^2]

    // Where the wing goes
    double positionGain = 0.7;           // speed towards the place / distance from it [1/s]
    double fastestDrift = 2.0;           // that speed [m/s]
    double speedGain = 2.0;              // acceleration / missing speed [1/s]
    double largestYaw = 60.0;            // [deg]
    double lowestAngleOfAttack = -5.0;   // nearly no lift: the wing has to lose speed [deg]
    double highestAngleOfAttack = 18.0;  // [deg]
    double highestPitch = 40.0;          // beta_c [deg]
    double leastTension = 20.0;          // more lift than the place needs keeps the tether this taut [N]

    // Winch
    double parkTether = 100.0;       // end of the ascent [m]
    double parkTime = 10.0;          // [s]
    double ascentForce = 60.0;       // tether is paid out when the force is higher [N]
    double ascentGain = 0.02;        // [m/s per N]
    double fastestAscent = 2.0;      // [m/s]
    double fastestDescent = 4.0;     // [m/s]
    double slowestDescent = 0.5;     // at the mast [m/s]
    double descentSlope = 0.094;     // descent speed / distance from the mast [1/s]
    double slowDistance = 2.0;       // before the mast, at the slowest speed [m]
    double fastestCrosswind = 10.0;  // the winch stands at this tangential speed in the descent [m/s] ...
    double crosswindRange = 4.0;     // ... and begins to be slower this much below [m/s]
    double highestForce = 2500.0;    // the winch stands at this force in the descent [N] ...
    double forceRange = 1000.0;      // ... and begins to be slower this much below [N]
    double leastAirspeed = 5.5;      // below it the winch pulls faster [m/s] ...
    double airspeedGain = 1.0;       // ... by this part of what is missing
    double fastestPull = 6.0;        // at most [m/s] ...
    double gentleDistance = 28.0;    // ... and less when the mast is nearer than this [m]
    double shortestOvershoot = 0.8;  // the tether may be this much shorter than the mast is far [m]

    void check(RangeCheck &check) const;
};

}  // namespace awe

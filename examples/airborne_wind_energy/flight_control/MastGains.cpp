// SPDX-License-Identifier: Apache-2.0
#include "MastGains.h"

#include "RangeCheck.h"

namespace awe {

void MastGains::check(RangeCheck &check) const
{
    check.within("mast.distance", distance, 3.0, 40.0, "m");
    check.within("mast.elevation", elevation, 20.0, 85.0, "deg");
    check.within("mast.startWind", startWind, 0.0, stormStartWind, "m/s");
    check.within("mast.landWind", landWind, 0.0, startWind, "m/s");
    check.within("mast.stormStartWind", stormStartWind, startWind, stormLandWind, "m/s");
    check.within("mast.stormLandWind", stormLandWind, stormStartWind, 100.0, "m/s");
    check.within("mast.lullWind", lullWind, 0.0, startWind, "m/s");
    check.within("mast.windFilterTime", windFilterTime, 1e-6, 1e6, "s");
    check.within("mast.lullFilterTime", lullFilterTime, 1e-6, 1e6, "s");
    check.within("mast.leastDockedTime", leastDockedTime, 0.0, 1e6, "s");
    check.within("mast.leastFlightTime", leastFlightTime, 0.0, 1e6, "s");
    check.within("mast.startTime", startTime, 0.0, 1e6, "s");
    check.within("mast.mass", mass, 1e-3, 1e6, "kg");
    check.within("mast.area", area, 1e-3, 1e6, "m²");
    check.within("mast.density", density, 1e-3, 100.0, "kg/m³");
    check.within("mast.gravity", gravity, 0.0, 100.0, "m/s²");
    check.within("mast.positionGain", positionGain, 0.0, 100.0, "1/s");
    check.within("mast.fastestDrift", fastestDrift, 0.0, 100.0, "m/s");
    check.within("mast.speedGain", speedGain, 0.0, 100.0, "1/s");
    check.within("mast.largestYaw", largestYaw, 0.0, 89.0, "deg");
    check.within("mast.lowestAngleOfAttack", lowestAngleOfAttack, -20.0, highestAngleOfAttack, "deg");
    check.within("mast.fastestCrosswind", fastestCrosswind, 0.1, 100.0, "m/s");
    check.within("mast.crosswindRange", crosswindRange, 0.1, 100.0, "m/s");
    check.within("mast.highestAngleOfAttack", highestAngleOfAttack, lowestAngleOfAttack, 25.0, "deg");
    check.within("mast.highestPitch", highestPitch, -90.0, 90.0, "deg");
    check.within("mast.leastTension", leastTension, 0.0, 1e6, "N");
    check.within("mast.parkTether", parkTether, distance, 1e5, "m");
    check.within("mast.parkTime", parkTime, 0.0, 1e6, "s");
    check.within("mast.ascentForce", ascentForce, 0.0, 1e6, "N");
    check.within("mast.ascentGain", ascentGain, 0.0, 10.0, "m/s per N");
    check.within("mast.fastestAscent", fastestAscent, 0.1, 100.0, "m/s");
    check.within("mast.fastestDescent", fastestDescent, slowestDescent, 100.0, "m/s");
    check.within("mast.slowestDescent", slowestDescent, 0.05, 10.0, "m/s");
    check.within("mast.descentSlope", descentSlope, 0.0, 10.0, "1/s");
    check.within("mast.slowDistance", slowDistance, 0.0, 100.0, "m");
    check.within("mast.highestForce", highestForce, 1.0, 1e9, "N");
    check.within("mast.forceRange", forceRange, 1.0, 1e9, "N");
    check.within("mast.leastAirspeed", leastAirspeed, 0.0, 100.0, "m/s");
    check.within("mast.airspeedGain", airspeedGain, 0.0, 10.0, "");
    check.within("mast.fastestPull", fastestPull, 0.0, 100.0, "m/s");
    check.within("mast.gentleDistance", gentleDistance, 0.1, 1000.0, "m");
    check.within("mast.shortestOvershoot", shortestOvershoot, 0.0, 0.9, "m");
}

}  // namespace awe

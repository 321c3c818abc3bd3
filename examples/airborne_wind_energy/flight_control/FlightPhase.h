// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace awe {

/// What the autopilot is doing: the pumping cycle of the power controller, then what the mast
/// controller does. The numbers are sent over the wire: keep them.
enum class FlightPhase : std::int8_t {
    Launch = 0,   ///< gain speed towards the zenith, tether length held
    Power = 1,    ///< first seconds of the figure eight: pitch up, wait for the force
    ReelOut = 2,  ///< figure eights, tether reels out and drives the generator
    Retract = 3,  ///< leave the eight towards the zenith
    ReelIn = 4,   ///< nose down the wind, little force, tether reels in
    Recover = 5,  ///< lull: the winch pulls the wing so that it keeps its airspeed
    Docked = 6,   ///< the wing hangs on the mast
    Ascend = 7,   ///< away from the mast, towards the zenith
    Park = 8,     ///< on the tether length of the cycle, towards the zenith
    Descend = 9   ///< back to the mast
};

constexpr int flightPhaseCount = 10;

/// "Launch", "Power", ...; "unknown" for a number that is none of them
const char *flightPhaseName(FlightPhase phase);

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#include "FlightPhase.h"

namespace awe {

const char *flightPhaseName(FlightPhase phase)
{
    switch (phase) {
    case FlightPhase::Launch:
        return "Launch";
    case FlightPhase::Power:
        return "Power";
    case FlightPhase::ReelOut:
        return "ReelOut";
    case FlightPhase::Retract:
        return "Retract";
    case FlightPhase::ReelIn:
        return "ReelIn";
    case FlightPhase::Recover:
        return "Recover";
    case FlightPhase::Docked:
        return "Docked";
    case FlightPhase::Ascend:
        return "Ascend";
    case FlightPhase::Park:
        return "Park";
    case FlightPhase::Descend:
        return "Descend";
    }
    return "unknown";
}

}  // namespace awe

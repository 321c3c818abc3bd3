// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightPhase.h"

namespace awe {

/// What the autopilot tells the actuators in one cycle.
struct AutopilotOutputs
{
    double pitchSpeed = 0.0;          // rate of beta_c [deg/s]
    double yawSpeed = 0.0;            // rate of gamma_c [deg/s]
    double tetherSpeed = 0.0;         // v_t [m/s], > 0 reels out
    double steering = 0.0;            // u_cmd of a steered wing [-], -1...1
    double turbineCoefficient = 0.0;  // c_dt of turbines on board [-]
    bool release = false;             // the mast lets the wing go
    FlightPhase phase = FlightPhase::Launch;
};

}  // namespace awe

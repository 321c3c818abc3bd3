// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace awe {

/// What acts on the plant during one step; held constant over it.
struct PlantInputs
{
    double pitchSpeed = 0.0;                                 // rate of beta_c [deg/s]
    double yawSpeed = 0.0;                                   // rate of gamma_c [deg/s]
    double tetherSpeed = 0.0;                                // v_t [m/s], > 0 reels out
    Eigen::Vector3d windVelocity = Eigen::Vector3d::Zero();  // w [3] [m/s], earth frame, uniform in space
    // Of an ExtendedPlant alone:
    Eigen::Vector3d turbulence = Eigen::Vector3d::Zero();  // the part of w that is the same at every height [3] [m/s]
    double steering = 0.0;                                 // u_cmd, with the turn-rate law [-], -1...1
    double turbineCoefficient = 0.0;                       // c_dt: drag of the turbines on board [-], >= 0
    bool release = false;                                  // the mast lets the wing go, and does not catch it
};

}  // namespace awe

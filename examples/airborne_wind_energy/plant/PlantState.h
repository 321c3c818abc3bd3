// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace awe {

/// State of the plant. Earth frame: x east, y north, z up, origin where the tether leaves the
/// ground.
struct PlantState
{
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // r [3] [m]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // v [3] [m/s]
    double pitchAngle = 0.0;                             // beta_c [deg], > 0 lifts the nose
    double yawAngle = 0.0;                               // gamma_c [deg], 0: nose to the zenith, not wrapped
    double tetherLength = 0.0;                           // l_t [m], unstretched
    double averagePower = 0.0;                           // first-order average of the power [W]
    double energy = 0.0;                                 // integral of the power [J]
};

}  // namespace awe

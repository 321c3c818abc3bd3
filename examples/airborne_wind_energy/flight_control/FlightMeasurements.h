// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace awe {

/// What the sensors tell the autopilot in one cycle. Earth frame: x east, y north, z up, origin at
/// the ground station.
struct FlightMeasurements
{
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // r [3] [m]; zero: nothing measured yet
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // v [3] [m/s]
    double pitchAngle = 0.0;                             // beta_c [deg]
    double yawAngle = 0.0;                               // gamma_c [deg], 0: nose to the zenith
    double angleOfAttack = 0.0;                          // alpha [deg]
    double tetherLength = 0.0;                           // l_t [m]
    double tetherForce = 0.0;                            // |F_t| [N]
    double airspeed = 0.0;                               // |v_r| [m/s]; only a steered wing needs it
    double windDirection = 0.0;                          // azimuth the wind blows to [deg], from x towards y
};

}  // namespace awe

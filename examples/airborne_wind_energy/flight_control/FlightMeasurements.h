// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace awe {

/// What an operator wants of an autopilot with a mast. The numbers are sent over the wire: keep
/// them.
enum class FlightRequest : std::int8_t {
    Automatic = 0,  ///< start when the wind is strong enough, land when it is not
    Fly = 1,        ///< start now; land only in a lull
    Land = 2        ///< land now and stay on the mast
};

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

    // Only an autopilot with a mast needs them:
    Eigen::Vector3d windVelocity = Eigen::Vector3d::Zero();  // at the wing [3] [m/s]
    bool isDocked = false;                                   // the wing hangs on the mast
    FlightRequest request = FlightRequest::Automatic;
};

}  // namespace awe

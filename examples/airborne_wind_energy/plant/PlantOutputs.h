// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantInputs.h"

#include <Eigen/Core>

namespace awe {

/// Everything the plant tells about one instant. Vectors are in the earth frame: x east, y north, z
/// up.
struct PlantOutputs
{
    PlantInputs inputs;                                                 // the inputs the forces belong to
    Eigen::Vector3d position = Eigen::Vector3d::Zero();                 // r [3] [m]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();                 // v [3] [m/s]
    Eigen::Vector3d bodyControlOrientation = Eigen::Vector3d::Zero();   // (0, beta_c, gamma_c) [deg]
    Eigen::Vector3d bodyPositionOrientation = Eigen::Vector3d::Zero();  // (0, 90 - elevation, azimuth) [deg], +-180
    double angleOfAttack = 0.0;                                         // alpha [deg]
    double dragCoefficient = 0.0;                                       // c_d [-], drag factor included
    double liftCoefficient = 0.0;                                       // c_l [-]
    double aweCoefficient = 0.0;                                        // c_AWE [-] of the plain wing
    Eigen::Vector3d gravitationalForce = Eigen::Vector3d::Zero();       // F_g [3] [N]
    Eigen::Vector3d aerodynamicForce = Eigen::Vector3d::Zero();         // F_ae [3] [N]
    Eigen::Vector3d tetherForce = Eigen::Vector3d::Zero();              // F_t [3] [N] on the wing, towards the ground
    double groundTension = 0.0;                                         // of the tether at the winch [N]; ExtendedPlant
    double tetherLength = 0.0;                                          // l_t [m], unstretched
    double power = 0.0;                                                 // P = v_t |F_t| [W], > 0 when reeling out
    double averagePower = 0.0;                                          // [W]
    double energy = 0.0;                                                // [J]
    bool crashed = false;                                               // the wing is, or was, on or below the ground
};

}  // namespace awe

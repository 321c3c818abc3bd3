// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AngleMath.h"

#include <Eigen/Core>

#include <cmath>

namespace awe {

/// A direction seen from its begin, such as that of the tether from the ground station: where the
/// wing is.
struct Sphere
{
    double distance = 0.0;    // R [m]
    double horizontal = 0.0;  // distance from the vertical axis [m]
    double cosElevation = 1.0, sinElevation = 0.0, cosAzimuth = 1.0, sinAzimuth = 0.0;

    explicit Sphere(const Eigen::Vector3d &r)
        : horizontal(std::sqrt(r.x() * r.x() + r.y() * r.y()))
    {
        distance = r.norm();
        if (horizontal > 0.0) {
            cosAzimuth = r.x() / horizontal;
            sinAzimuth = r.y() / horizontal;
        }
        if (distance > 0.0) {
            cosElevation = horizontal / distance;
            sinElevation = r.z() / distance;
        }
    }

    Eigen::Vector3d outwards() const { return {cosElevation * cosAzimuth, cosElevation * sinAzimuth, sinElevation}; }
    Eigen::Vector3d zenithwards() const
    {
        return {-sinElevation * cosAzimuth, -sinElevation * sinAzimuth, cosElevation};
    }
    Eigen::Vector3d azimuthwards() const { return {-sinAzimuth, cosAzimuth, 0.0}; }
};

/// Sine and cosine of the control angles.
struct Attitude
{
    double sinPitch = 0.0, cosPitch = 1.0, sinYaw = 0.0, cosYaw = 1.0;

    /// \param pitchAngle  beta_c [deg] \param yawAngle  gamma_c [deg]
    static Attitude of(double pitchAngle, double yawAngle)
    {
        const double pitch = pitchAngle * radiansPerDegree, yaw = yawAngle * radiansPerDegree;
        return {std::sin(pitch), std::cos(pitch), std::sin(yaw), std::cos(yaw)};
    }
};

/// The body axes of a wing at the end of a tether of direction \a sphere, in the earth frame.
struct WingFrame
{
    Eigen::Vector3d outwards;   // e_r, away from the begin of the tether
    Eigen::Vector3d tailwards;  // x_b
    Eigen::Vector3d sideways;   // y_b
    Eigen::Vector3d topwards;   // z_b

    WingFrame(const Sphere &sphere, const Attitude &attitude)
        : outwards(sphere.outwards())
    {
        const Eigen::Vector3d zenithwards = sphere.zenithwards();
        const Eigen::Vector3d azimuthwards = sphere.azimuthwards();
        const Eigen::Vector3d tail = attitude.sinYaw * azimuthwards - attitude.cosYaw * zenithwards;  // before pitching
        sideways = attitude.sinYaw * zenithwards + attitude.cosYaw * azimuthwards;
        topwards = attitude.sinPitch * tail + attitude.cosPitch * outwards;
        tailwards = attitude.cosPitch * tail - attitude.sinPitch * outwards;
    }
};

}  // namespace awe

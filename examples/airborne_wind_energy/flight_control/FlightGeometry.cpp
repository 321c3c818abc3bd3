// SPDX-License-Identifier: Apache-2.0
#include "FlightGeometry.h"

#include "AngleMath.h"

#include <cmath>

namespace awe {

FlightGeometry FlightGeometry::from(const FlightMeasurements &measurements, double windAzimuth)
{
    const Eigen::Vector3d &r = measurements.position;
    const Eigen::Vector3d &v = measurements.velocity;
    const double horizontal = std::sqrt(r.x() * r.x() + r.y() * r.y());
    const double cosAzimuth = horizontal > 0.0 ? r.x() / horizontal : 1.0;
    const double sinAzimuth = horizontal > 0.0 ? r.y() / horizontal : 0.0;

    FlightGeometry g;
    g.distance = r.norm();
    g.height = r.z();
    g.elevation = std::atan2(r.z(), horizontal);
    g.cosElevation = g.distance > 0.0 ? horizontal / g.distance : 1.0;
    const double sinElevation = g.distance > 0.0 ? r.z() / g.distance : 0.0;
    g.azimuth = wrapRadians(std::atan2(r.y(), r.x()) - windAzimuth);
    g.climbSpeed = v.z();
    g.zenithSpeed = g.cosElevation * v.z() - sinElevation * (cosAzimuth * v.x() + sinAzimuth * v.y());
    g.azimuthSpeed = cosAzimuth * v.y() - sinAzimuth * v.x();
    g.tangentialSpeed = std::sqrt(g.zenithSpeed * g.zenithSpeed + g.azimuthSpeed * g.azimuthSpeed);
    g.heading = wrapDegrees(-measurements.yawAngle);
    return g;
}

double FlightGeometry::course(double slowestSpeed) const
{
    return tangentialSpeed < slowestSpeed ? heading : std::atan2(azimuthSpeed, zenithSpeed) * degreesPerRadian;
}

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightMeasurements.h"

namespace awe {

/// Where the wing is and where it goes on the sphere around the ground station ("small earth").
///
///     elevation = atan2(z, hypot(x, y)),  azimuth phi = atan2(y, x) - wind azimuth, wrapped
///     v_u = v . e_u (towards the zenith),  v_a = v . e_a (to larger azimuth)
///     course chi = atan2(v_a, v_u), heading psi = -gamma_c; both 0 towards the zenith, > 0 to
///     larger azimuth
struct FlightGeometry
{
    double distance = 0.0;         // R [m]
    double height = 0.0;           // z [m]
    double elevation = 0.0;        // [rad]
    double cosElevation = 1.0;     // [-]
    double azimuth = 0.0;          // phi, from the wind direction [rad], -pi...pi
    double climbSpeed = 0.0;       // v_z [m/s]
    double zenithSpeed = 0.0;      // v_u [m/s]
    double azimuthSpeed = 0.0;     // v_a [m/s]
    double tangentialSpeed = 0.0;  // hypot(v_u, v_a) [m/s]
    double heading = 0.0;          // psi [deg], -180...180

    /// \param windAzimuth  azimuth the wind blows to [rad]
    static FlightGeometry from(const FlightMeasurements &measurements, double windAzimuth);

    /// chi [deg]; the heading when the wing is slower than \a slowestSpeed [m/s], where chi says
    /// nothing
    double course(double slowestSpeed) const;
};

}  // namespace awe

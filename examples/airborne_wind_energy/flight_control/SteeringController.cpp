// SPDX-License-Identifier: Apache-2.0
#include "SteeringController.h"

#include "AngleMath.h"

namespace awe {

SteeringController::SteeringController(const AutopilotGains &gains)
    : m_gains(gains)
{
}

double SteeringController::steering(double yawSpeed, const FlightMeasurements &measurements,
                                    const FlightGeometry &geometry) const
{
    if (m_gains.turnRateFactor == 0.0)
        return 0.0;
    const double airspeed = std::max(measurements.airspeed, m_gains.slowestSteeringSpeed);
    const double heading = geometry.heading * radiansPerDegree;
    const double horizontal = geometry.distance * geometry.cosElevation;
    // At the zenith the azimuth says nothing.
    const double azimuthRate = horizontal > geometry.distance / 1000.0 ? geometry.azimuthSpeed / horizontal : 0.0;
    const double turnRate = -yawSpeed * radiansPerDegree - azimuthRate * std::sin(geometry.elevation)
        - m_gains.weightFactor / airspeed * std::sin(heading) * geometry.cosElevation;
    return saturate(turnRate / (m_gains.turnRateFactor * airspeed), 1.0);
}

}  // namespace awe

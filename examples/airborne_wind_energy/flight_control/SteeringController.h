// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "FlightGeometry.h"
#include "FlightMeasurements.h"

namespace awe {

/// Behind the orientation controller, for a wing that the air turns: the steering that turns it as
/// fast as wanted. It inverts the turn-rate law (ExtendedPlant).
///
///     psi' = -yawSpeed
///     u_cmd = sat((psi' - az' sin(el) - c_2 / V sin(psi) cos(el)) / (c_1 V), 1),  V = max(airspeed, 5 m/s)
class SteeringController
{
public:
    explicit SteeringController(const AutopilotGains &gains);

    /// \param yawSpeed  wanted gamma_c' [deg/s]
    /// \return u_cmd [-]; 0 for a wing whose yaw speed is the command itself
    double steering(double yawSpeed, const FlightMeasurements &measurements, const FlightGeometry &geometry) const;

private:
    AutopilotGains m_gains;
};

}  // namespace awe

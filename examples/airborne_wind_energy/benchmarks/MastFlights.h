// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ClosedLoopFlight.h"

namespace awe {

// Flights at a mast: tests judge them, and awe_mast_flights shows their figures.

inline const Eigen::Vector3d downwind = Eigen::Vector3d(5.0, 3.0, 0.0).normalized();
constexpr double mastDayDuration = 2400.0;  // [s]

/// \a parameters with a mast. \param speed  of the mean wind [m/s] \param turbulence  its intensity
inline ClosedLoopParameters atMast(double speed, double turbulence = 0.0, ClosedLoopParameters parameters = {})
{
    parameters.options.mast.isPresent = parameters.gains.mast.isPresent = true;
    parameters.wind.meanVelocity = speed * downwind;
    parameters.wind.turbulenceIntensity = turbulence;
    return parameters;
}

/// 3 -> 9 -> 3 m/s in 40 min.
inline ClosedLoopParameters dayAtMast(double turbulence = 0.0)
{
    ClosedLoopParameters parameters = atMast(9.0, turbulence);
    parameters.wind.dayShare = 3.0 / 9.0;
    parameters.wind.dayDuration = mastDayDuration;
    return parameters;
}

/// Four minutes of flight by request, and a landing by request, which may take three minutes.
inline FlightReport startAndLand(const ClosedLoopParameters &parameters)
{
    constexpr int longestLanding = 180;  // [s]
    constexpr double restTime = 5.0;     // [s]
    ClosedLoopFlight flight(parameters);
    flight.setRequest(FlightRequest::Fly);
    flight.fly(240.0);
    flight.setRequest(FlightRequest::Land);
    for (int second = 0; second < longestLanding && !flight.plant().isDocked(); ++second)
        flight.fly(1.0);
    flight.fly(restTime);
    return flight.report();
}

}  // namespace awe

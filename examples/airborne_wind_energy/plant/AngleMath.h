// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace awe {

constexpr double pi = 3.14159265358979323846;
constexpr double degreesPerRadian = 180.0 / pi;
constexpr double radiansPerDegree = pi / 180.0;

/// The same angle in -180...180 [deg]
inline double wrapDegrees(double angle)
{
    return angle >= -180.0 && angle <= 180.0 ? angle : std::remainder(angle, 360.0);
}

/// The same angle in -pi...pi [rad]
inline double wrapRadians(double angle)
{
    return angle >= -pi && angle <= pi ? angle : std::remainder(angle, 2.0 * pi);
}

/// \a value, held between -limit and +limit
inline double saturate(double value, double limit)
{
    return std::clamp(value, -limit, limit);
}

}  // namespace awe

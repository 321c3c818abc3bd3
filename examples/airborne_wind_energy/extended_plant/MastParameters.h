// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <string>

namespace awe {

/// A mast that carries the wing before its flight and after it. Its top stands downwind of the
/// winch.
///
///     docks    |r - top| <= reach and |r| <= distance + 0.3 m, while the mast does not let it go
///     crashes  |r| < distance - 1 m: the wing hit the mast
struct MastParameters
{
    static constexpr double farthest = 40.0;  // the wing comes as near as 50 m when it recovers [m]

    bool isPresent = false;
    double distance = 12.0;              // of the top from the winch [m]
    double elevation = 70.0;             // of the top, seen from the winch [deg]
    double azimuth = 30.96375653207352;  // of the top, from x towards y [deg]: downwind of the wind (5, 3, 0)
    double reach = 2.5;                  // the wing docks when it is this near to the top [m]

    /// Calls visit(name, value, smallest, largest, unit) for each constant that a file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("distance", parameters.distance, 3.0, farthest, "m");
        visit("elevation", parameters.elevation, 20.0, 85.0, "deg");
        visit("azimuth", parameters.azimuth, -180.0, 180.0, "deg");
        visit("reach", parameters.reach, 0.1, 10.0, "m");
    }

    /// Where the wing is while it is docked [3] [m].
    Eigen::Vector3d top() const;

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe

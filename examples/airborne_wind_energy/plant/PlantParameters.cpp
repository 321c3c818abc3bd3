// SPDX-License-Identifier: Apache-2.0
#include "PlantParameters.h"

#include "AngleMath.h"
#include "RangeCheck.h"

#include <cmath>

namespace awe {

PlantState PlantParameters::defaultInitialState()
{
    return stateAtRest(30.0, 30.963756532073521, 100.0);  // azimuth of the wind (5, 3, 0)
}

PlantState PlantParameters::stateAtRest(double elevation, double azimuth, double distance)
{
    const double e = elevation * radiansPerDegree, a = azimuth * radiansPerDegree;
    PlantState state;
    state.position = distance * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    state.pitchAngle = 9.0;
    state.tetherLength = distance;
    return state;
}

std::string PlantParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    check.within("step", step, 1e-6, 0.05, "s");
    for (int i = 0; i < 3; ++i) {
        check.within("initialState.position", initialState.position[i], -1e6, 1e6, "m");
        check.within("initialState.velocity", initialState.velocity[i], -1e3, 1e3, "m/s");
    }
    check.within("distance of initialState.position from the ground station", initialState.position.norm(), 1e-3, 1e6,
                 "m");
    check.within("initialState.pitchAngle", initialState.pitchAngle, -1e6, 1e6, "deg");
    check.within("initialState.yawAngle", initialState.yawAngle, -1e6, 1e6, "deg");
    check.within("initialState.tetherLength", initialState.tetherLength, 1e-3, 1e6, "m");
    check.within("initialState.averagePower", initialState.averagePower, -1e12, 1e12, "W");
    check.within("initialState.energy", initialState.energy, -1e15, 1e15, "J");
    return check.message();
}

}  // namespace awe

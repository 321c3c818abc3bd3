// SPDX-License-Identifier: Apache-2.0
#include "PlantOptions.h"

#include "PlantParameters.h"
#include "RangeCheck.h"

namespace awe {

std::string TetherParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    check.within("segments", segments, 1, mostSegments, "");
    if (kind == TetherKind::Segments && segments > 1)  // a node without mass would have an infinite acceleration
        check.within("density of the tether", density, leastNodeDensity, 2e4, "kg/m³");
    return check.message();
}

std::string SteeringParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    return check.message();
}

Eigen::Vector3d MastParameters::top() const
{
    return PlantParameters::stateAtRest(elevation, azimuth, distance).position;
}

std::string MastParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    return check.message();
}

PlantOptions PlantOptions::realistic()
{
    PlantOptions options;
    options.air.profile = WindProfile::Log;
    options.tether.kind = TetherKind::Segments;
    options.steering.kind = SteeringKind::TurnRate;
    options.hasMachine = true;
    return options;
}

PlantOptions PlantOptions::drag()
{
    PlantOptions options;
    options.hasTurbines = true;
    return options;
}

bool PlantOptions::isThesis() const
{
    return air.profile == WindProfile::Uniform && !air.isThinner && tether.kind == TetherKind::Spring
        && steering.kind == SteeringKind::Kinematic && !hasMachine && !mast.isPresent && !hasTurbines;
}

std::string PlantOptions::validate() const
{
    for (const std::string &complaint :
         {air.validate(), tether.validate(), steering.validate(), machine.validate(), mast.validate()}) {
        if (!complaint.empty())
            return complaint;
    }
    return {};
}

std::string PlantOptions::validateFor(const PlantParameters &kite) const
{
    const std::string complaint = validate();
    if (!complaint.empty() || tether.kind != TetherKind::Segments)
        return complaint;
    RangeCheck check;
    check.within("tether length at the start", mast.isPresent ? mast.distance : kite.initialState.tetherLength,
                 TetherParameters::shortestSegment * tether.segments, 1e6, "m");
    return check.message();
}

}  // namespace awe

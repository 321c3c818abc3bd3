// SPDX-License-Identifier: Apache-2.0
#include "PlantOptions.h"

#include "RangeCheck.h"

namespace awe {

namespace {

template<typename Parameters>
void checkConstants(const Parameters &parameters, RangeCheck *check)
{
    Parameters::visitConstants(parameters,
                               [check](const char *name, double value, double smallest, double largest,
                                       const char *unit) { check->within(name, value, smallest, largest, unit); });
}

}  // namespace

std::string TetherParameters::validate() const
{
    RangeCheck check;
    checkConstants(*this, &check);
    check.within("segments", segments, 1, mostSegments, "");
    return check.message();
}

std::string SteeringParameters::validate() const
{
    RangeCheck check;
    checkConstants(*this, &check);
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
        && steering.kind == SteeringKind::Kinematic && !hasMachine && !hasTurbines;
}

std::string PlantOptions::validate() const
{
    for (const std::string &complaint : {air.validate(), tether.validate(), steering.validate(), machine.validate()}) {
        if (!complaint.empty())
            return complaint;
    }
    return {};
}

}  // namespace awe

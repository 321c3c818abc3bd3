// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AirParameters.h"
#include "PlantParameters.h"
#include "SteeringParameters.h"
#include "TetherParameters.h"
#include "WinchDriveParameters.h"

#include <string>

namespace awe {

/// A plant with options. The values here are the plant of the thesis: no option is on.
struct ExtendedParameters
{
    PlantParameters kite;  // wing, ground, initial state, and the spring of the tether
    AirParameters air;
    TetherParameters tether;
    SteeringParameters steering;
    bool hasMachine = false;  // whether the winch is a drive that has to follow the tether speed
    WinchDriveParameters machine;
    bool hasTurbines = false;  // whether turbines on board brake the wing: drag mode

    /// true if no option is on
    bool isThesis() const;

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe

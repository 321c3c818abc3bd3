// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AirParameters.h"
#include "MastParameters.h"
#include "SteeringParameters.h"
#include "TetherParameters.h"
#include "WinchDriveParameters.h"

#include <string>

namespace awe {

struct PlantParameters;

/// What a plant has beyond that of the thesis. The values here are the latter: no option is on.
struct PlantOptions
{
    AirParameters air;
    TetherParameters tether;
    SteeringParameters steering;
    bool hasMachine = false;  // whether the winch is a drive that has to follow the tether speed
    WinchDriveParameters machine;
    MastParameters mast;
    bool hasTurbines = false;  // whether turbines on board brake the wing: drag mode

    /// What a plant that is built has: log wind, a tether in segments, a machine at the winch, and
    /// a wing that the air turns.
    static PlantOptions realistic();
    /// Turbines on board.
    static PlantOptions drag();

    /// true if no option is on
    bool isThesis() const;

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
    /// The same, also for what only options and \a kite together show.
    std::string validateFor(const PlantParameters &kite) const;
};

}  // namespace awe

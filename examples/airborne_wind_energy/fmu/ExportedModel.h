// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CompactModelNode.h"
#include "KiteConfiguration.h"

namespace awe {

/// The kite of the thesis, as an FMU: two-phase, because a host wants the outputs at the end of a
/// step.
class ExportedModel : public CompactModelNode
{
public:
    ExportedModel()
        : CompactModelNode(simulation({}))
    {
        setTwoPhase(true);
    }

private:
    static KiteSimulation simulation(const KiteConfiguration &kite)
    {
        return KiteSimulation(kite.plantIn(kite.wind), kite.wind, kite.substeps);
    }
};

}  // namespace awe

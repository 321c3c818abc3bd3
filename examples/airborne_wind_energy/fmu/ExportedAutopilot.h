// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotNode.h"

namespace awe {

/// The autopilot with its usual gains, as an FMU.
class ExportedAutopilot : public AutopilotNode
{
public:
    ExportedAutopilot()
        : AutopilotNode(AutopilotGains::safe())
    {
    }
};

}  // namespace awe

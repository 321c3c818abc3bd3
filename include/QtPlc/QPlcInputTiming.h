// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

/// Which value of a signal a node reads: `QPlcInput<double> m_speed{this, "tetherSpeed", QPlcInputTiming::SameCycle};`
///
/// A same-cycle input has direct feed-through to all outputs of its node: the node is asked after the writer of the signal has answered. Nodes that read
/// each other in the same cycle would be an algebraic loop, which the master refuses; a two-phase node (QPlcSlaveNode::setTwoPhase()) closes such a loop.
struct QPlcInputTiming
{
    enum Value : quint8 {
        LastCycle,  ///< of the cycle before: one cycle of dead time, and all nodes compute at once (default)
        SameCycle   ///< of the cycle at hand: no dead time, and nodes compute one after the other
    };
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

/// Which value of a signal a node reads: that of the last cycle, or that of the same cycle.
///
/// \code
/// class Controller : public QPlcCompactSlaveNode
/// {
/// public:
///     Controller() : QPlcCompactSlaveNode("Controller") {}
///
/// private:
///     QPlcInput<double> m_speed{this, "tetherSpeed", QPlcInputTiming::SameCycle};  // [m/s]
/// };
/// \endcode
///
/// A same-cycle input has direct feedthrough to all outputs of its node: the master asks this node
/// after the writer of the signal has answered. Nodes that read each other in the same cycle form
/// an algebraic loop, which the master refuses. A two-phase node (QPlcSlaveNode::setTwoPhase())
/// breaks such a loop.
///
/// \threadsafe it holds an enumeration only
///
/// \ingroup nodes
struct QPlcInputTiming
{
    /// The two timings.
    enum Value : quint8 {
        /// Value of the cycle before: one cycle of dead time; all nodes compute at once (default).
        LastCycle,
        /// Value of this cycle: no dead time; the node computes after the writer of the signal.
        SameCycle
    };
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterControl.h"
#include "MasterError.h"
#include "NodeSessions.h"
#include "RealTimePhase.h"

namespace qplc {

/// What is wrong in a plant: turns the loss and the failure of nodes, and limits that cycles have
/// passed, into errors and events of the master, and knows which of them stands in the way of a
/// reset.
class MasterFaults
{
public:
    MasterFaults(MasterControl &master, MasterError &error, const NodeSessions &nodes, const RealTimePhase &phase);

    /// The code of a node has failed: the plant stops. What follows from the first fault is its
    /// echo and says nothing new.
    void nodeFailed(const QString &node, bool isCritical, const QString &text);
    /// A node whose session was at \a stage has left. \param wasAwaited the sequence at hand waited
    /// for it
    void nodeLeft(const NodeSlot &slot, NodeSession::Stage stage, bool wasAwaited, const QString &text);
    /// Cycles have found a limit passed, and are safe already. \param overrunLimit  that they have
    void tripped(const CycleEvent &event, int overrunLimit);
    /// The overrun policy is Stop, and the cycles have ended. \param period  [ns]
    void overrun(const CycleEvent &event, std::int64_t period);
    /// A person or program stops safely: no node is to blame.
    void safeStop(const QString &reason);

    /// Why the latched fault cannot be reset yet; empty: it can.
    QString remainingCause() const;

private:
    void blame(const QString &node, bool mustReturn);

    MasterControl &m_master;
    MasterError &m_error;
    const NodeSessions &m_nodes;
    const RealTimePhase &m_phase;
    QString m_culprit;          // node that the latched fault is about; empty: none
    bool m_mustReturn = false;  // the culprit was lost: it has to be there again before a reset
};

}  // namespace qplc

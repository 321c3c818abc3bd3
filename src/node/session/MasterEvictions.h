// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterServer.h"
#include "NeededNodes.h"
#include "RealTimePhase.h"

namespace qplc {

/// Lets people and programs keep a node or a person out of a plant, and let it in again.
class MasterEvictions
{
public:
    /// All of them outlive this object.
    MasterEvictions(Evictions &evictions, MasterServer &server, const NodeSessions &nodes, NeededNodes &needed,
                    Journal &journal, const RealTimePhase &phase);

    /// Ends the connections of \a name, and refuses it from now on.
    /// \param asker  null: the program of the master
    /// \return false, with the reason in \a refusal
    bool evict(const QString &name, const MasterConnection *asker, Refusal *refusal);
    /// Lets \a name in again. Parameters as evict().
    bool admit(const QString &name, const MasterConnection *asker, Refusal *refusal);

private:
    /// Why \a asker may not evict \a name; no error: it may.
    Refusal refusalOf(const QString &name, const MasterConnection *asker) const;

    Evictions &m_evictions;
    MasterServer &m_server;
    const NodeSessions &m_nodes;
    NeededNodes &m_needed;
    Journal &m_journal;
    const RealTimePhase &m_phase;
};

}  // namespace qplc

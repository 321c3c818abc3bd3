// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "NodeSessions.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/Roster.h"

#include <set>

namespace qplc {

/// Makes the rosters of a phase: who takes part in its cycles, and what becomes of signals whose
/// writer does not.
class RosterMaker
{
public:
    RosterMaker(const QPlcSignalTable &table, const NodeRegistry &registry, const NodeSessions &nodes,
                const Leases &leases);

    /// A phase begins: no node has written anything in it.
    void forgetWritten() { m_written.clear(); }
    /// The phase has begun: no node has left it.
    void forgetAbandoned() { m_abandoned.clear(); }
    /// A node leaves before it was ready for cycles: nobody writes its signals.
    void abandon(const NodeSlot &slot);
    /// Of all nodes that are ready for cycles.
    Roster make();

private:
    std::vector<bool> safeSignals(const Roster &roster);

    const QPlcSignalTable &m_table;
    const NodeRegistry &m_registry;
    const NodeSessions &m_nodes;
    const Leases &m_leases;
    std::vector<bool> m_written;            // by index: signals that nodes have written since the phase began
    std::set<QPlcSignalIndex> m_abandoned;  // of this phase
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "RosterMaker.h"

namespace qplc {

RosterMaker::RosterMaker(const QPlcSignalTable &table, const NodeRegistry &registry, const NodeSessions &nodes,
                         const Leases &leases)
    : m_table(table)
    , m_registry(registry)
    , m_nodes(nodes)
    , m_leases(leases)
{
}

void RosterMaker::abandon(const NodeSlot &slot)
{
    for (const PayloadLayout::Field &field : slot.outputLayout.fields())
        m_abandoned.insert(field.signal);
}

/// Signals that are to be safe when the master stops safely: what nodes write, or have written in
/// this phase, what is taken over, and whatever else has a value for it in the table. Not what the
/// master writes itself.
std::vector<bool> RosterMaker::safeSignals(const Roster &roster)
{
    m_written.resize(std::size_t(m_table.size()));
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        for (const PayloadLayout::Field &field : slot->outputLayout.fields())
            m_written[field.signal] = true;
    }
    std::vector<bool> safe = m_written;
    for (QPlcSignalIndex signal = 0; signal < safe.size(); ++signal) {
        if (m_registry.writer(signal) == NodeRegistry::masterName())
            safe[signal] = false;
        else if (m_table.at(signal).safe.isValid() || (signal < roster.held.size() && roster.held[signal]))
            safe[signal] = true;
    }
    return safe;
}

Roster RosterMaker::make()
{
    // Nobody waits until a listener is ready: what is sent to it meanwhile waits in its socket.
    const auto takesPart = [](const NodeSession &node) {
        return node.stage() == NodeSession::Running || (!node.isAwaited() && node.stage() == NodeSession::Starting);
    };
    Roster roster;
    for (const std::shared_ptr<NodeSlot> &slot : m_registry.nodes()) {
        const std::shared_ptr<NodeSession> node = m_nodes.of(slot.get());
        if (node && takesPart(*node))
            roster.nodes.push_back(slot);
    }
    roster.held = m_leases.mask();
    roster.terms = m_leases.terms();
    roster.safe = safeSignals(roster);
    for (const QPlcSignalIndex signal : m_abandoned) {
        if (m_registry.writer(signal).isEmpty())
            roster.abandoned.push_back(signal);
    }
    return roster;
}

}  // namespace qplc

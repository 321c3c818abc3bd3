// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "NodeSession.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"
#include "node/statistics/StatisticSignals.h"

namespace qplc {

/// Initial values on their way from the nodes into the process image, and from there to the nodes.
class InitialValues
{
public:
    InitialValues(MasterCycle &cycle, const NodeRegistry &registry, const Leases &leases, StatisticSignals &statistics);

    /// What nodes have written before counts for nothing, and statistics begin at 0.
    /// \param usualHold  [cycles] of signals without `hold`
    void forget(std::int64_t usualHold);
    /// What is wrong with \a outputs; empty: nothing.
    QString faultOf(const NodeSlot &slot, const QByteArray &outputs) const;
    /// Whether \a outputs have the size that \a node has registered with; else it is dropped.
    bool hasSize(NodeSession &node, const QByteArray &outputs) const;
    /// Takes checked outputs, but for signals that somebody holds. \pre no cycle runs
    void store(NodeSlot &slot, const QByteArray &outputs);
    /// The outputs of all nodes have been taken. \pre no cycle runs
    void allTaken();
    /// The inputs of a node that is about to get them, with the newest values; also while cycles
    /// run.
    QByteArray inputsFor(NodeSlot &slot) const;
    /// Instead of the newest values, nodes get those of a recording; empty: the newest ones.
    void setRecordedInputs(const QByteArray &inputs) { m_recorded = inputs; }
    /// Number on the wire of cycle 0 of the phase at hand.
    std::uint64_t cycleZero() const { return m_cycle.cycleZero(); }

private:
    MasterCycle &m_cycle;
    const NodeRegistry &m_registry;
    const Leases &m_leases;
    StatisticSignals &m_statistics;
    QByteArray m_recorded;
};

}  // namespace qplc

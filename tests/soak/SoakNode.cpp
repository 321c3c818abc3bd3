// SPDX-License-Identifier: Apache-2.0
#include "SoakNode.h"

namespace soak {

SoakNode::SoakNode(const NodeOptions &options, HistoryWriter &history)
    : QPlcCompactSlaveNode(nodeName(options.node), ErrorZeroOrderHold)
    , m_options(options)
    , m_history(history)
    , m_written(this, options.shape, options.node)
    , m_seen(this, options.shape, (options.node + options.shape.nodes - 1) % options.shape.nodes)
{
    if (hasOwnTable(options.node)) {  // others have no qualities, either
        setSignalTable(table(options.shape));
        setReceivesQuality(true);
    }
    connect(this, &QPlcSlaveNode::realTimeHasStarted, this, &SoakNode::recordPhase);
    connect(this, &QPlcSlaveNode::disconnectedFromMaster, this,
            [this] { m_history.append(Record::MasterLost, m_options.node); });
    connect(this, &QPlcSlaveNode::errorWithMaster, this, [this] { m_history.append(Record::KeptOut, m_options.node); });
}

// The first step may come before the news that the phase has begun: they are of two threads.
void SoakNode::recordPhase()
{
    if (!m_isPhaseRecorded.exchange(true))
        m_history.append(Record::Phase, m_options.node);
}

void SoakNode::reset()
{
    write(m_written, m_options.life, ++m_counter);
    m_history.append(Record::Reset, m_options.node, {0, m_counter, m_written.check});
}

void SoakNode::step(const QPlcCycle &cycle)
{
    recordPhase();
    const Stamp seen = m_seen.stamp();
    write(m_written, m_options.life, ++m_counter);
    m_history.append(Record::Step, m_options.node,
                     {cycle.missedCycles(), m_counter, m_written.check, seen.life, seen.counter, seen.check,
                      m_seen.computedCheck(), bitsOf(m_seen.drive),
                      receivesQuality() ? m_seen.drive.quality().toByte() : Record::NoQuality},
                     cycle.number());
}

void SoakNode::stopped()
{
    m_history.append(Record::PhaseEnded, m_options.node);
    m_isPhaseRecorded = false;
}

void SoakNode::safeState(SafeStateReason reason)
{
    m_history.append(
        Record::Safe, m_options.node,
        {bitsOf(m_seen.drive), reason == PhaseEnded ? 1U : 0U, reason == MasterStopsSafely ? 1U : 0U, bitsOf(m_limit)});
}

}  // namespace soak

// SPDX-License-Identifier: Apache-2.0
#include "StartSequence.h"

#include <algorithm>
#include <iterator>

namespace qplc {

StartSequence::StartSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes,
                             StartMessages &starts, PhaseProfile &profile, PhaseCycles &cycles, JoinSequence &join)
    : m_master(master)
    , m_step(step)
    , m_nodes(nodes)
    , m_starts(starts)
    , m_profile(profile)
    , m_cycles(cycles)
    , m_join(join)
{
}

/// A node that has not come so far joins the others later.
NodeSessions::List StartSequence::initialized(const NodeSessions::List &nodes) const
{
    NodeSessions::List found;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(found),
                 [](const auto &node) { return node->stage() == NodeSession::Initialized; });
    return found;
}

void StartSequence::begin()
{
    m_profile.fix();  // again: what it depends on may have been set since the initialization
    NodeSessions::List told = initialized(m_nodes.awaited());
    const NodeSessions::List listeners = initialized(m_nodes.listeners());
    m_step.begin(SequenceStep::Start, told,
                 [this](const QString &text) { m_master.apply(MasterEvent::SequenceFailed, text); });
    for (const auto &listener : listeners)
        listener->setStage(NodeSession::Starting);
    told.insert(told.end(), listeners.begin(), listeners.end());
    m_starts.restart();
    m_starts.place(told);
    const quint64 step = m_step.number();
    for (const auto &node : told) {
        const std::optional<NodeSession::Answer> answer = node->start(m_starts.begin(*node));
        if (!m_step.isStill(step))
            return;
        if (answer && !answer->fault.isEmpty()) {
            m_master.apply(MasterEvent::SequenceFailed,
                           QStringLiteral("node '%1': %2").arg(node->name(), answer->fault));
            return;
        }
        if (answer)
            m_step.answered(*node);
    }
    advance();
}

void StartSequence::handleAnswer(NodeSession &node)
{
    m_step.answered(node);
    advance();
}

void StartSequence::advance()
{
    if (m_step.complete())
        startCycles();
}

void StartSequence::startCycles()
{
    const quint64 step = m_step.number();
    const auto goesOn = [&] { return m_cycles.isRunning() && m_step.number() == step; };
    QString error;
    if (!m_cycles.start(&error)) {
        m_master.apply(MasterEvent::ThreadFailed, error);
        return;
    }
    m_step.end();
    m_master.apply(MasterEvent::CyclesStarted);
    for (const auto &node : m_nodes.all()) {
        if (goesOn() && node->stage() == NodeSession::Running)  // else who heard of it has ended the phase
            node->cyclesStarted(m_profile.fixed().value);
    }
    if (goesOn())
        Q_EMIT realTimeHasStarted();
    Q_EMIT done();
    // Whoever came while the others were being started joins now.
    for (const auto &node : m_nodes.all()) {
        if (goesOn() && node->stage() == NodeSession::Idle)
            m_join.begin(*node);
    }
}

}  // namespace qplc

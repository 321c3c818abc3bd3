// SPDX-License-Identifier: Apache-2.0
#include "JoinSequence.h"

namespace qplc {

JoinSequence::JoinSequence(const SequenceStep &step, StepTimer &timer, const NodeSessions &nodes, InitialValues &values,
                           StartMessages &starts, PhaseCycles &cycles, const PhaseProfile &profile, Journal &journal)
    : m_step(step)
    , m_timer(timer)
    , m_nodes(nodes)
    , m_values(values)
    , m_starts(starts)
    , m_cycles(cycles)
    , m_profile(profile)
    , m_journal(journal)
{
}

void JoinSequence::begin(NodeSession &node)
{
    node.setStage(NodeSession::GivingOutputs);
    node.setFailed(false);
    const bool mayGoOn = m_cycles.isRunning() && !node.isListener() && m_profile.defaults().keepsState;
    waitForAnswer();
    node.askOutputs(mayGoOn ? std::optional<quint64>(m_cycles.cycleZero()) : std::nullopt);
}

void JoinSequence::handleAnswer(NodeSession &node, const QByteArray &outputs, bool goesOn)
{
    if (node.stage() == NodeSession::GivingOutputs) {
        if (!storeOutputs(node, outputs))
            return;
        node.slot()->goesOn = goesOn && m_cycles.isRunning();
        tellReturn(node, goesOn);
    }
    node.setStage(NodeSession::Stage(node.stage() + 1));
    goOn(node);
}

bool JoinSequence::storeOutputs(NodeSession &node, const QByteArray &outputs)
{
    if (!m_values.hasSize(node, outputs))
        return false;
    NodeSlot &slot = *node.slot();
    slot.initialOutputs.assign(outputs.begin(), outputs.end());
    const QString fault = m_values.faultOf(slot, outputs);
    if (!fault.isEmpty())
        node.drop(fault);
    else if (!m_cycles.isRunning())
        m_values.store(slot, outputs);
    return fault.isEmpty();
}

/// A node that was in this phase before is there again: as the same process, or as one that was
/// started anew.
void JoinSequence::tellReturn(const NodeSession &node, bool goesOn)
{
    if (!m_cycles.isRunning() || node.isListener() || !m_cycles.hasLeft(node.name()))
        return;
    if (goesOn)
        m_journal.tell(JournalEvent::Info, JournalEvent::Node, node.name(),
                       QStringLiteral("node %1 goes on where it was").arg(node.name()));
    else
        m_journal.tell(JournalEvent::Warning, JournalEvent::Node, node.name(),
                       QStringLiteral("node %1 begins again at its initial state").arg(node.name()));
}

void JoinSequence::goOn(NodeSession &node)
{
    const bool mayStart = m_cycles.isRunning() || m_step.kind() == SequenceStep::Start;
    if (node.stage() == NodeSession::OutputsGiven && m_step.kind() != SequenceStep::CollectOutputs) {
        node.setStage(NodeSession::Initializing);
        waitForAnswer();
        node.giveInputs(m_values.inputsFor(*node.slot()));
    } else if (node.stage() == NodeSession::Initialized && mayStart) {
        node.setStage(NodeSession::Starting);
        waitForAnswer();
        m_starts.place({node.shared_from_this()});
        node.start(m_starts.begin(node));
    } else if (node.stage() == NodeSession::Running && m_cycles.isRunning()) {
        m_cycles.renewRoster();
        m_journal.nodeReturned(node.name());
    }
}

void JoinSequence::waitForAnswer()
{
    if (m_isWaiting)
        return;
    m_isWaiting = true;
    m_timer.start([this] { dropSilentNodes(); });
}

/// A node that was asked during the last time gets another one.
void JoinSequence::dropSilentNodes()
{
    m_isWaiting = false;
    for (const auto &node : m_nodes.all()) {
        const bool isOfStep = m_step.isUnderWay() && node->isAwaited();
        if (!node->owesAnswer() || isOfStep)
            continue;
        if (node->wasSeen()) {
            node->drop(noAnswerText(node->stage(), m_timer.length(), {node}));
        } else {
            node->setSeen();
            waitForAnswer();
        }
    }
}

}  // namespace qplc

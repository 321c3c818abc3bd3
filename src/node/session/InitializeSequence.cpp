// SPDX-License-Identifier: Apache-2.0
#include "InitializeSequence.h"

namespace qplc {

InitializeSequence::InitializeSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes,
                                       InitialValues &values, PhaseProfile &profile, JoinSequence &join)
    : m_master(master)
    , m_step(step)
    , m_nodes(nodes)
    , m_values(values)
    , m_profile(profile)
    , m_join(join)
{
}

quint64 InitializeSequence::beginStep(SequenceStep::Kind kind, const NodeSessions::List &nodes)
{
    return m_step.begin(kind, nodes,
                        [this](const QString &text) { m_master.apply(MasterEvent::SequenceFailed, text); });
}

void InitializeSequence::begin()
{
    m_profile.fix();
    m_values.forget(m_profile.defaults().hold);
    const NodeSessions::List nodes = m_nodes.awaited();
    const quint64 step = beginStep(SequenceStep::CollectOutputs, nodes);
    for (const auto &listener : m_nodes.listeners())
        m_join.begin(*listener);
    for (const auto &node : nodes) {
        const std::optional<NodeSession::Answer> answer = node->askOutputs(std::nullopt);
        if (!m_step.isStill(step) || (answer && !accept(*node, *answer)))
            return;
    }
    advance();
}

/// Takes the answer to the step at hand. \return false when it ends the sequence
bool InitializeSequence::accept(NodeSession &node, const NodeSession::Answer &answer)
{
    QString fault = answer.fault;
    if (fault.isEmpty() && m_step.kind() == SequenceStep::CollectOutputs) {
        fault = m_values.faultOf(*node.slot(), answer.outputs);
        if (fault.isEmpty())
            m_values.store(*node.slot(), answer.outputs);
    }
    if (!fault.isEmpty()) {
        m_master.apply(MasterEvent::SequenceFailed, QStringLiteral("node '%1': %2").arg(node.name(), fault));
        return false;
    }
    m_step.answered(node);
    return true;
}

void InitializeSequence::handleAnswer(NodeSession &node, const QByteArray &outputs)
{
    if (m_step.kind() == SequenceStep::CollectOutputs) {
        if (!m_values.hasSize(node, outputs))
            return;
        node.slot()->initialOutputs.assign(outputs.begin(), outputs.end());
    }
    if (accept(node, {QString(), outputs}))
        advance();
}

void InitializeSequence::advance()
{
    if (!m_step.complete())
        return;
    if (m_step.kind() == SequenceStep::CollectOutputs)
        distributeInputs();
    else
        end();
}

void InitializeSequence::distributeInputs()
{
    m_values.allTaken();
    const NodeSessions::List nodes = m_step.nodes();
    const quint64 step = beginStep(SequenceStep::DistributeInputs, nodes);
    for (const auto &listener : m_nodes.listeners())
        m_join.goOn(*listener);
    for (const auto &node : nodes) {
        const std::optional<NodeSession::Answer> answer = node->giveInputs(m_values.inputsFor(*node->slot()));
        if (!m_step.isStill(step) || (answer && !accept(*node, *answer)))
            return;
    }
    advance();
}

void InitializeSequence::end()
{
    const quint64 step = m_step.number();
    m_master.announce({true, {}});
    Q_EMIT statesInitialized();
    if (!m_step.isStill(step))
        return;
    m_step.end();
    Q_EMIT done();
}

}  // namespace qplc

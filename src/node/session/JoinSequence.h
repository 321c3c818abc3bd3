// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "InitialValues.h"
#include "SequenceStep.h"
#include "StartMessages.h"

namespace qplc {

/// Nodes that nobody waits for: listeners, and nodes that join while others run. Each of them goes
/// through initialization and start at its own pace, as far as the others have come. A node that
/// does not answer is dropped: it would keep its name and its signals for ever.
class JoinSequence
{
public:
    /// \param timer  a node may owe an answer from one end of it to the next one
    JoinSequence(const SequenceStep &step, StepTimer &timer, const NodeSessions &nodes, InitialValues &values,
                 StartMessages &starts, PhaseCycles &cycles, const PhaseProfile &profile, Journal &journal);

    /// Begins at the top, whatever \a node has not answered yet.
    void begin(NodeSession &node);
    /// The answer that \a node owes.
    /// \param goesOn  the outputs are those of its last step in this phase
    void handleAnswer(NodeSession &node, const QByteArray &outputs, bool goesOn);
    /// Asks \a node for what comes next, if the others have come so far.
    void goOn(NodeSession &node);

private:
    bool storeOutputs(NodeSession &node, const QByteArray &outputs);
    void tellReturn(const NodeSession &node, bool goesOn);
    void waitForAnswer();
    void dropSilentNodes();

    const SequenceStep &m_step;
    StepTimer &m_timer;
    const NodeSessions &m_nodes;
    InitialValues &m_values;
    StartMessages &m_starts;
    PhaseCycles &m_cycles;
    const PhaseProfile &m_profile;
    Journal &m_journal;
    bool m_isWaiting = false;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "JoinSequence.h"
#include "MasterControl.h"

namespace qplc {

/// The start of all nodes that are initialized: waits until each of them is ready, then starts the
/// cycles.
class StartSequence : public QObject
{
    Q_OBJECT
public:
    StartSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes, StartMessages &starts,
                  PhaseProfile &profile, PhaseCycles &cycles, JoinSequence &join);

    void begin();
    /// The answer that \a node owes: it is ready.
    void handleAnswer(NodeSession &node);
    /// Goes on when nobody owes an answer any more.
    void advance();

Q_SIGNALS:
    /// Cycles run, and all nodes know.
    void realTimeHasStarted();
    /// The sequence has come to its end, though who heard of it may have ended the cycles already.
    void done();

private:
    void startCycles();
    NodeSessions::List initialized(const NodeSessions::List &nodes) const;

    MasterControl &m_master;
    SequenceStep &m_step;
    const NodeSessions &m_nodes;
    StartMessages &m_starts;
    PhaseProfile &m_profile;
    PhaseCycles &m_cycles;
    JoinSequence &m_join;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "JoinSequence.h"
#include "MasterControl.h"

namespace qplc {

/// The initialization of all nodes: collects their initial outputs, then gives each node its inputs
/// out of them.
class InitializeSequence : public QObject
{
    Q_OBJECT
public:
    InitializeSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes, InitialValues &values,
                       PhaseProfile &profile, JoinSequence &join);

    void begin();
    /// The answer that \a node owes.
    void handleAnswer(NodeSession &node, const QByteArray &outputs);
    /// Goes on when nobody owes an answer any more.
    void advance();

Q_SIGNALS:
    /// All nodes have their inputs. Who hears of it may end the sequence.
    void statesInitialized();
    /// The sequence has come to its end.
    void done();

private:
    bool accept(NodeSession &node, const NodeSession::Answer &answer);
    void distributeInputs();
    quint64 beginStep(SequenceStep::Kind kind, const NodeSessions::List &nodes);
    void end();

    MasterControl &m_master;
    SequenceStep &m_step;
    const NodeSessions &m_nodes;
    InitialValues &m_values;
    PhaseProfile &m_profile;
    JoinSequence &m_join;
};

}  // namespace qplc

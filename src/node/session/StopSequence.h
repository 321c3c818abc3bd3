// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterControl.h"
#include "SequenceStep.h"

namespace qplc {

/// The ways to an end: each of them tells all nodes, and waits for none.
class StopSequence
{
public:
    StopSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes);

    /// Ends an initialization or a start.
    void cancel(const QString &reason);
    /// The cycles have ended.
    void stop(const QString &reason);
    /// The cycles are safe.
    void makeSafe();

private:
    MasterControl &m_master;
    SequenceStep &m_step;
    const NodeSessions &m_nodes;
};

}  // namespace qplc

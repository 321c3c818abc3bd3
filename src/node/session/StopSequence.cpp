// SPDX-License-Identifier: Apache-2.0
#include "StopSequence.h"

namespace qplc {

StopSequence::StopSequence(MasterControl &master, SequenceStep &step, const NodeSessions &nodes)
    : m_master(master)
    , m_step(step)
    , m_nodes(nodes)
{
}

void StopSequence::cancel(const QString &reason)
{
    const bool wasStarting = m_step.kind() == SequenceStep::Start;
    m_step.end();
    if (!wasStarting)
        m_master.announce({false, reason});
    for (const auto &node : m_nodes.all())
        node->cancel(reason, wasStarting);
}

void StopSequence::stop(const QString &reason)
{
    for (const auto &node : m_nodes.all())
        node->stop(reason);
}

void StopSequence::makeSafe()
{
    for (const auto &node : m_nodes.all())
        node->tellSafe();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "MasterFaults.h"

namespace qplc {

namespace {

/// What the events of a trip are: Overrun is about the master itself, the others about a node.
JournalEvent::Kind kindOfTrip(CycleEvent::Kind kind)
{
    switch (kind) {
    case CycleEvent::TrippedByLateAnswer:
    case CycleEvent::TrippedByLateAnswers:
    case CycleEvent::TrippedByWait:
    case CycleEvent::TrippedByNode:
        return JournalEvent::Late;
    case CycleEvent::TrippedByFailure:
    case CycleEvent::TrippedBySafeNode:
        return JournalEvent::Fault;
    default:
        return JournalEvent::Overrun;
    }
}

QString tripText(const CycleEvent &event, const QString &node, int overrunLimit)
{
    const double milliseconds = double(event.duration) * 1e-6;
    switch (event.kind) {
    case CycleEvent::TrippedByLateAnswer:
        return QStringLiteral("node '%1' was late in cycle %2").arg(node).arg(event.cycle);
    case CycleEvent::TrippedByLateAnswers:
        return QStringLiteral("critical node '%1' was late too often, last in cycle %2").arg(node).arg(event.cycle);
    case CycleEvent::TrippedByWait:
        return QStringLiteral("node '%1' did not answer cycle %2 within %3 ms")
            .arg(node)
            .arg(event.cycle)
            .arg(milliseconds, 0, 'f', 0);
    case CycleEvent::TrippedByNode:
        return QStringLiteral("node '%1' asked for it in cycle %2").arg(node).arg(event.cycle);
    case CycleEvent::TrippedByFailure:
        return QStringLiteral("the code of critical node '%1' failed in cycle %2").arg(node).arg(event.cycle);
    case CycleEvent::TrippedBySafeNode:
        return QStringLiteral("critical node '%1' is in its safe state since cycle %2").arg(node).arg(event.cycle);
    case CycleEvent::TrippedByGap:
        return QStringLiteral("the master stood still for %1 ms before cycle %2")
            .arg(milliseconds, 0, 'f', 0)
            .arg(event.cycle);
    default:
        return QStringLiteral("%1 overruns in a row, the last one of them in cycle %2")
            .arg(overrunLimit + 1)
            .arg(event.cycle);
    }
}

}  // namespace

MasterFaults::MasterFaults(MasterControl &master, MasterError &error, const NodeSessions &nodes,
                           const RealTimePhase &phase)
    : m_master(master)
    , m_error(error)
    , m_nodes(nodes)
    , m_phase(phase)
{
}

/// Who has to be well again before a reset, should the state become SafeStop now.
void MasterFaults::blame(const QString &node, bool mustReturn)
{
    if (m_master.state() == QPlcMasterNode::SafeStop)
        return;
    m_culprit = node;
    m_mustReturn = mustReturn;
}

void MasterFaults::nodeFailed(const QString &node, bool isCritical, const QString &text)
{
    if (m_phase.isRunning() && m_master.state() != QPlcMasterNode::SafeStop)
        m_error.set(QPlcMasterNode::NodeError, text, node, JournalEvent::Fault);
    blame(node, false);
    m_master.apply(isCritical ? MasterEvent::CriticalNodeFailed : MasterEvent::NodeFailed, text);
}

void MasterFaults::nodeLeft(const NodeSlot &slot, NodeSession::Stage stage, bool wasAwaited, const QString &text)
{
    if (wasAwaited) {
        m_master.apply(MasterEvent::SequenceFailed, text);
    } else if (stage == NodeSession::Running && slot.critical) {
        const QString critical = QStringLiteral("critical %1").arg(text);
        if (m_master.state() != QPlcMasterNode::SafeStop)
            m_error.set(QPlcMasterNode::NodeError, critical, slot.name, JournalEvent::Fault);
        blame(slot.name, true);
        m_master.apply(MasterEvent::CriticalNodeLeft, critical);
    } else if (!slot.listener) {
        m_master.apply(MasterEvent::NodeLeft, text);
    }
}

void MasterFaults::tripped(const CycleEvent &event, int overrunLimit)
{
    if (!m_phase.isRunning() || m_master.state() == QPlcMasterNode::SafeStop)
        return;
    const QString name = m_phase.nodeName(event.node);
    const QString text = tripText(event, name, overrunLimit);
    const JournalEvent::Kind kind = kindOfTrip(event.kind);
    if (kind != JournalEvent::Overrun) {
        blame(name, event.kind == CycleEvent::TrippedBySafeNode);  // it closes its connection, and begins again
        m_error.set(QPlcMasterNode::NodeError, text, name, kind);
    } else {
        blame(QString(), false);
        m_error.set(QPlcMasterNode::RealTimeError, text, NodeRegistry::masterName(), kind);
    }
    m_master.apply(MasterEvent::CyclesTripped, text);
}

void MasterFaults::overrun(const CycleEvent &event, std::int64_t period)
{
    if (!m_phase.isRunning())
        return;
    const QString text
        = QStringLiteral(
              "cycle %1 could begin only %2 ms after its time, and a period is %3 ms: the overrun policy "
              "'stop' ends the real-time phase; shorten what the cycle before computes or waits for, give the "
              "cycle thread a real-time priority, or set another overrun policy")
              .arg(event.cycle)
              .arg(double(event.duration) * 1e-6, 0, 'f', 3)
              .arg(double(period) * 1e-6, 0, 'f', 3);
    m_error.set(QPlcMasterNode::RealTimeError, text, NodeRegistry::masterName(), JournalEvent::Overrun);
    m_master.apply(MasterEvent::OverrunStop, text);
}

void MasterFaults::safeStop(const QString &reason)
{
    blame({}, false);
    m_master.apply(MasterEvent::SafeStop,
                   m_master.state() == QPlcMasterNode::Initializing ? QStringLiteral("stopped safely: %1").arg(reason)
                                                                    : reason);
}

QString MasterFaults::remainingCause() const
{
    if (m_master.state() != QPlcMasterNode::SafeStop || m_culprit.isEmpty())
        return {};
    for (const auto &node : m_nodes.all()) {
        if (node->name() != m_culprit || node->isListener())
            continue;
        return node->slot()->bucket > 0 ? QStringLiteral("node '%1' still answers late, or not at all").arg(m_culprit)
                                        : QString();
    }
    return m_mustReturn ? QStringLiteral("node '%1' is not back; start it again").arg(m_culprit) : QString();
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "MasterReports.h"

#include "node/cycle/FrameLog.h"

namespace qplc {

MasterReports::MasterReports(MasterControl &master, MasterCycle &cycle, const NodeRegistry &registry,
                             const NodeSessions &nodes, RealTimePhase &phase, MasterFaults &faults,
                             const PhaseSettings &settings, Journal &journal)
    : m_master(master)
    , m_cycle(cycle)
    , m_registry(registry)
    , m_nodes(nodes)
    , m_phase(phase)
    , m_faults(faults)
    , m_settings(settings)
    , m_journal(journal)
    , m_refusedValues(journal,
                      [&cycle](QPlcSignalIndex signal) {
                          const SignalGuard &guard = cycle.signalGuard();
                          return guard.nonFinite(signal) + guard.outOfRange(signal);
                      })
    , m_notifier(cycle.reports().descriptor(), QSocketNotifier::Read)
{
    connect(&m_notifier, &QSocketNotifier::activated, this, &MasterReports::take);
}

void MasterReports::take()
{
    m_cycle.reports().take([this](const CycleEvent &event) { report(event); },
                           [](const TappedFrame &frame) { logFrame(NodeRegistry::masterName(), frame); });
    if (!m_becameSafe.isEmpty())
        m_journal.becameSafe(m_becameSafe);  // of one node, as a rule: told together
    m_becameSafe.clear();
}

void MasterReports::takeLast()
{
    take();
    m_refusedValues.end();
}

void MasterReports::report(const CycleEvent &event)
{
    switch (event.kind) {
    case CycleEvent::WaitingForNode:
        m_isWaitTold = event.node != 0;
        m_master.apply(MasterEvent::WaitBegan);
        break;
    case CycleEvent::WaitingEnded:
        m_master.apply(MasterEvent::WaitEnded);
        break;
    case CycleEvent::NodeFaulted:
        codeFailed(event);
        break;
    case CycleEvent::LinkClosed:
        if (const auto node = m_nodes.of(m_registry.find(event.node).get()))
            node->drop(QStringLiteral("its cyclic connection was closed"));
        break;
    case CycleEvent::Overrun:
        m_faults.overrun(event, m_cycle.period());
        break;
    case CycleEvent::Ended:
        if (m_settings.cycleLimit + m_settings.cyclesWanted > 0)
            m_master.apply(MasterEvent::CycleLimitReached, QStringLiteral("the cycle limit was reached"));
        break;
    case CycleEvent::TrippedByLateAnswer:
    case CycleEvent::TrippedByLateAnswers:
    case CycleEvent::TrippedByWait:
    case CycleEvent::TrippedByGap:
    case CycleEvent::TrippedByOverruns:
    case CycleEvent::TrippedByNode:
    case CycleEvent::TrippedByFailure:
    case CycleEvent::TrippedBySafeNode:
        m_faults.tripped(event, m_settings.overrunLimit);
        break;
    default:
        tellJournal(event);
        break;
    }
}

/// What changes nothing for the master, but is worth a line.
void MasterReports::tellJournal(const CycleEvent &event)
{
    const auto signal = [&]() -> const QPlcSignalDefinition & { return m_cycle.table().at(event.signal); };
    const QString node = m_phase.nodeName(event.node);
    switch (event.kind) {
    case CycleEvent::LateAnswer:
        m_journal.answeredLate(node, event.cycle);
        Q_EMIT realTimeViolated(node, event.cycle);
        break;
    case CycleEvent::ValueRefused:
        m_refusedValues.refused(event.signal, signal().name, node, faultText(signal(), event.fault));
        break;
    case CycleEvent::SourceChanged:
        m_journal.sourceChanged(signal().name, m_phase.nodeName(quint16(event.duration)), node);
        break;
    case CycleEvent::SignalSafe:
        m_becameSafe.append(QStringLiteral("%1 = %2").arg(signal().name, signal().safeValue().toString()));
        break;
    case CycleEvent::ForgedFrame:
        m_journal.tell(
            JournalEvent::Warning, JournalEvent::Security, node,
            QStringLiteral("frames from the address of node %1 have a wrong seal since cycle %2: another sender "
                           "uses this address, or the frames are changed on the way")
                .arg(node)
                .arg(event.cycle));
        break;
    default:
        break;  // of nodes
    }
}

/// A listener in another process cannot go on: it has to leave, and the plant goes on.
void MasterReports::codeFailed(const CycleEvent &event)
{
    const std::shared_ptr<NodeSlot> slot = m_registry.find(event.node);
    const std::shared_ptr<NodeSession> node = m_nodes.of(slot.get());
    if (!slot && m_phase.wasListener(event.node))
        return;  // it has reported more than once
    const QString what = node ? node->codeFailed() : QStringLiteral("its code failed");
    if (node && !node->isAwaited()) {
        node->drop(what);
        return;
    }
    const QString name = m_phase.nodeName(event.node);
    m_phase.keepCycles(QStringLiteral("the failure of node '%1'").arg(name));
    m_faults.nodeFailed(name, slot && slot->critical,
                        QStringLiteral("node '%1' in cycle %2: %3").arg(name).arg(event.cycle).arg(what));
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
// What the cycle thread of a master reports, and what becomes of it.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"
#include "node/cycle/FrameLog.h"

#include <algorithm>

using Event = qplc::MasterEvent;
using qplc::CycleEvent;
using qplc::NodeSlot;

QString QPlcMasterNodePrivate::nodeName(quint16 id) const
{
    const std::shared_ptr<NodeSlot> slot = registry->find(id);
    if (slot)
        return slot->name;
    const qplc::GoneNodes::Node *gone = m_gone.find(id);
    return gone ? gone->name : QStringLiteral("number %1").arg(id);
}

void QPlcMasterNodePrivate::takeReports()
{
    cycle->reports().take(
        [this](const CycleEvent &event) { report(event); },
        [](const qplc::TappedFrame &frame) { qplc::logFrame(qplc::NodeRegistry::masterName(), frame); });
    if (!m_becameSafe.isEmpty())
        journal.becameSafe(m_becameSafe);  // of one node, as a rule: told together
    m_becameSafe.clear();
}

void QPlcMasterNodePrivate::report(const CycleEvent &event)
{
    switch (event.kind) {
    case CycleEvent::LateAnswer:
        journal.answeredLate(nodeName(event.node), event.cycle);
        Q_EMIT q->realTimeViolated(nodeName(event.node), event.cycle);
        break;
    case CycleEvent::WaitingForNode:
        m_isWaitTold = event.node != 0;
        apply(Event::WaitBegan);
        break;
    case CycleEvent::WaitingEnded:
        apply(Event::WaitEnded);
        break;
    case CycleEvent::ValueRefused:
        refusedValues.refused(event.signal, table.at(event.signal).name, nodeName(event.node),
                              qplc::faultText(table.at(event.signal), event.fault));
        break;
    case CycleEvent::SourceChanged:
        journal.sourceChanged(table.at(event.signal).name, nodeName(quint16(event.duration)), nodeName(event.node));
        break;
    case CycleEvent::SignalSafe:
        m_becameSafe.append(
            QStringLiteral("%1 = %2").arg(table.at(event.signal).name, table.at(event.signal).safeValue().toString()));
        break;
    case CycleEvent::NodeFaulted: {
        const std::shared_ptr<NodeSlot> slot = registry->find(event.node);
        const std::shared_ptr<qplc::LocalNode> local = localNode(slot.get());
        const QString what = local ? local->codeFailed() : QStringLiteral("its code failed");
        if (!dropFaulty(event.node, what))
            fault(nodeName(event.node), isCritical(event.node),
                  QStringLiteral("node '%1' in cycle %2: %3").arg(nodeName(event.node)).arg(event.cycle).arg(what));
        break;
    }
    case CycleEvent::ForgedFrame:
        journal.tell(
            qplc::JournalEvent::Warning, qplc::JournalEvent::Security, nodeName(event.node),
            QStringLiteral(
                "frames from the address of node %1 have a wrong seal since cycle %2: another sender uses this "
                "address, or the frames are changed on the way")
                .arg(nodeName(event.node))
                .arg(event.cycle));
        break;
    case CycleEvent::LinkClosed:
        if (const std::shared_ptr<NodeSlot> slot = registry->find(event.node)) {
            if (Connection *connection = server->connectionOf(slot.get()))
                server->drop(connection, QStringLiteral("its cyclic connection was closed"));
        }
        break;
    case CycleEvent::Overrun:
        stopAfterOverrun(event);
        break;
    case CycleEvent::Ended:
        if (cycleLimit + m_cyclesWanted > 0)
            apply(Event::CycleLimitReached, QStringLiteral("the cycle limit was reached"));
        break;
    case CycleEvent::TrippedByLateAnswer:
    case CycleEvent::TrippedByLateAnswers:
    case CycleEvent::TrippedByWait:
    case CycleEvent::TrippedByGap:
    case CycleEvent::TrippedByOverruns:
    case CycleEvent::TrippedByNode:
        tripped(event);
        break;
    case CycleEvent::WatchdogTimedOut:
    case CycleEvent::ToldSafeStop:
        break;
    }
}

/// The overrun policy is Stop, and the cycle thread has ended.
void QPlcMasterNodePrivate::stopAfterOverrun(const CycleEvent &event)
{
    if (!isRunning())
        return;
    const QString text
        = QStringLiteral(
              "cycle %1 could begin only %2 ms after its time, and a period is %3 ms: the overrun policy "
              "'stop' ends the real-time phase; shorten what the cycle before computes or waits for, give the "
              "cycle thread a real-time priority, or set another overrun policy")
              .arg(event.cycle)
              .arg(double(event.duration) * 1e-6, 0, 'f', 3)
              .arg(double(cycle->period()) * 1e-6, 0, 'f', 3);
    setError(QPlcMasterNode::RealTimeError, text, qplc::NodeRegistry::masterName(), qplc::JournalEvent::Overrun);
    apply(Event::OverrunStop, text);
}

/// A listener in another process cannot go on: it has to leave, and the plant goes on. \return false when the node is none
bool QPlcMasterNodePrivate::dropFaulty(quint16 id, const QString &text)
{
    const std::shared_ptr<NodeSlot> slot = registry->find(id);
    Connection *connection = slot && slot->listener && !slot->local ? server->connectionOf(slot.get()) : nullptr;
    if (connection)
        server->drop(connection, text);
    const qplc::GoneNodes::Node *gone = slot ? nullptr : m_gone.find(id);
    return connection || (gone && gone->isListener);  // gone: it has reported more than once
}

bool QPlcMasterNodePrivate::isCritical(quint16 id) const
{
    const std::shared_ptr<NodeSlot> slot = registry->find(id);
    return slot && slot->critical;
}

/// A node cannot go on: the plant stops. What follows from the first fault is its echo and says nothing new.
void QPlcMasterNodePrivate::fault(const QString &node, bool isCritical, const QString &text)
{
    const bool isNews = isRunning() && state != QPlcMasterNode::SafeStop;
    if (isNews)
        setError(QPlcMasterNode::NodeError, text, node, qplc::JournalEvent::Fault);
    blame(node, false);
    apply(isCritical ? Event::CriticalNodeFailed : Event::NodeFailed, text);
}

void QPlcMasterNodePrivate::nodeLost(Connection *connection, const QString &reason)
{
    const bool isMissed = connection->stage > Connection::Attached && !connection->slot->listener;
    if (isMissed)  // while cycles run, what it wrote is missing from now on
        journal.raise(QStringLiteral("node ") + connection->name,
                      isRunning() ? qplc::JournalEvent::Error : qplc::JournalEvent::Warning, qplc::JournalEvent::Node,
                      connection->name,
                      QStringLiteral("node %1 is gone in the middle of its work: %2").arg(connection->name, reason));
    else
        journal.tell(qplc::JournalEvent::Info, qplc::JournalEvent::Node, connection->name,
                     QStringLiteral("node %1 has left: %2").arg(connection->name, reason));
    const auto participant = std::find(m_participants.begin(), m_participants.end(), connection);
    const bool wasAwaited = m_step != Step::None && participant != m_participants.end();
    if (participant != m_participants.end())
        m_participants.erase(participant);
    m_gone.add({connection->slot->id, connection->name, connection->slot->listener});
    const bool wasRunning = connection->stage == Connection::Running;
    if (wasRunning) {
        giveRoster();
    } else if (isRunning() && connection->stage >= Connection::OutputsGiven) {
        for (const qplc::PayloadLayout::Field &field : connection->slot->outputLayout.fields())
            m_abandoned.insert(field.signal);
        giveRoster();
    }
    Q_EMIT q->nodeLost(connection->name, reason);
    const QString text = QStringLiteral("node '%1' has left: %2").arg(connection->name, reason);
    if (wasAwaited)
        sequenceFailed(text);
    else if (wasRunning && connection->slot->critical)
        criticalNodeLost(connection->name, text);
    else if (connection->stage >= Connection::Attached && !connection->slot->listener)
        apply(Event::NodeLeft, text);
}

void QPlcMasterNodePrivate::criticalNodeLost(const QString &node, const QString &text)
{
    if (state != QPlcMasterNode::SafeStop)
        setError(QPlcMasterNode::NodeError, QStringLiteral("critical %1").arg(text), node, qplc::JournalEvent::Fault);
    blame(node, true);
    apply(Event::CriticalNodeLeft, QStringLiteral("critical %1").arg(text));
}

// SPDX-License-Identifier: Apache-2.0
// The states of QPlcMasterNodePrivate: the table carried out, safe stop, arming and reset.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"
#include "node/state/SlaveStates.h"
#include "node/state/StateText.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"

using Action = qplc::MasterAction;
using Event = qplc::MasterEvent;
using qplc::NodeSlot;

bool QPlcMasterNodePrivate::apply(Event event, const QString &reason)
{
    const auto &cell = qplc::masterStates().at(state, event);
    if (cell.verdict == qplc::Verdict::Ignored)
        return true;
    if (cell.verdict == qplc::Verdict::Refused) {
        tellRefusal(event, cell.text);
        return false;
    }
    prepareFor(cell.action);
    enter(cell.next, reason);
    if (state == cell.next)  // else who heard of it has done something
        carryOut(cell.action, reason);
    return true;
}

void QPlcMasterNodePrivate::tellRefusal(Event event, const char *text)
{
    QString sentence = QString::fromLatin1(text);
    sentence.replace(QStringLiteral("%1"), stateReason);
    if (event == Event::ResetTooEarly)
        sentence.replace(QStringLiteral("%2"), remainingCause());
    setError(QPlcMasterNode::StateError,
             QStringLiteral("%1 is not possible in state %2: %3")
                 .arg(QLatin1String(qplc::requestName(event)), qplc::stateText(QLatin1String(qplc::nameOf(state))),
                      sentence));
}

void QPlcMasterNodePrivate::enter(QPlcMasterNode::State newState, const QString &reason)
{
    if (state == newState)
        return;
    using State = QPlcMasterNode::State;
    const bool isTransient = newState == State::WaitingForLateSlaves
        || (state == State::WaitingForLateSlaves && newState == State::RealTime);
    state = newState;
    stateReason = state == State::SafeStop || state == State::Fault ? reason : QString();
    if (state == State::RealTime && !isTransient)
        askedStop = {};
    arming.disarm();
    const QString words = qplc::stateText(QLatin1String(qplc::nameOf(state)));
    if (!isTransient || m_isWaitTold)
        journal.stateChanged(reason.isEmpty() ? words : QStringLiteral("%1: %2").arg(words, reason), isTransient);
    Q_EMIT q->stateChanged(newState);
}

/// What has to be done before the next state is there.
void QPlcMasterNodePrivate::prepareFor(Action action)
{
    switch (action) {
    case Action::EndCycles:
    case Action::Unlatch:
        endCycles();
        break;
    case Action::MakeCyclesSafe:
        cycle->makeSafe();
        break;
    default:
        break;
    }
}

/// What is done in the state that has been reached.
void QPlcMasterNodePrivate::carryOut(Action action, const QString &reason)
{
    switch (action) {
    case Action::CollectOutputs:
    case Action::CollectThenStart:
        m_startAfterwards = action == Action::CollectThenStart;
        collectOutputs();
        break;
    case Action::StartNodes:
        m_startAfterwards = true;
        beginStart();
        break;
    case Action::IssueToken:
        arming.arm(qplc::Host::current().random() | 1, qplc::monotonicNow());
        journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::State, qplc::NodeRegistry::masterName(),
                     QStringLiteral("armed: one start is permitted within 5 s"));
        break;
    case Action::EndSequence:
        endSequence(reason);
        break;
    case Action::EndCycles:
    case Action::Unlatch:
        tellStopped(reason);
        break;
    case Action::MakeCyclesSafe:
    case Action::LatchReason:
        tellSafeStop();
        break;
    case Action::LetJoin:
        if (m_joiner)
            join(m_joiner);
        break;
    case Action::ForgetInitialization:
    case Action::None:
        break;
    }
}

// ---- safe stop ----

void QPlcMasterNodePrivate::safeStop(const QString &reason)
{
    blame({}, false);
    apply(Event::SafeStop,
          state == QPlcMasterNode::Initializing ? QStringLiteral("stopped safely: %1").arg(reason) : reason);
}

/// Who has to be well again before a reset, should the state become SafeStop now.
void QPlcMasterNodePrivate::blame(const QString &node, bool mustReturn)
{
    if (state == QPlcMasterNode::SafeStop)
        return;
    m_culprit = node;
    m_mustReturn = mustReturn;
}

void QPlcMasterNodePrivate::tellSafeStop()
{
    for (const auto &node : std::vector<std::shared_ptr<qplc::LocalNode>>(m_localNodes))
        node->tellSafeStop();
    Q_EMIT q->safelyStopped(stateReason);
}

/// The cycles have found a limit passed, and are safe already.
void QPlcMasterNodePrivate::tripped(const qplc::CycleEvent &event)
{
    if (!isRunning() || state == QPlcMasterNode::SafeStop)
        return;
    using qplc::CycleEvent;
    using qplc::JournalEvent;
    const QString name = nodeName(event.node);
    const double milliseconds = double(event.duration) * 1e-6;
    const bool isOfNode = event.kind == CycleEvent::TrippedByLateAnswer
        || event.kind == CycleEvent::TrippedByLateAnswers || event.kind == CycleEvent::TrippedByWait
        || event.kind == CycleEvent::TrippedByNode;
    QString text;
    switch (event.kind) {
    case CycleEvent::TrippedByLateAnswer:
        text = QStringLiteral("node '%1' was late in cycle %2").arg(name).arg(event.cycle);
        break;
    case CycleEvent::TrippedByLateAnswers:
        text = QStringLiteral("critical node '%1' was late too often, last in cycle %2").arg(name).arg(event.cycle);
        break;
    case CycleEvent::TrippedByWait:
        text = QStringLiteral("node '%1' did not answer cycle %2 within %3 ms")
                   .arg(name)
                   .arg(event.cycle)
                   .arg(milliseconds, 0, 'f', 0);
        break;
    case CycleEvent::TrippedByNode:
        text = QStringLiteral("node '%1' asked for it in cycle %2").arg(name).arg(event.cycle);
        break;
    case CycleEvent::TrippedByGap:
        text = QStringLiteral("the master stood still for %1 ms before cycle %2")
                   .arg(milliseconds, 0, 'f', 0)
                   .arg(event.cycle);
        break;
    default:
        text = QStringLiteral("%1 overruns in a row, the last one of them in cycle %2")
                   .arg(overrunLimit + 1)
                   .arg(event.cycle);
        break;
    }
    blame(isOfNode ? name : QString(), false);
    setError(isOfNode ? QPlcMasterNode::NodeError : QPlcMasterNode::RealTimeError, text,
             isOfNode ? name : qplc::NodeRegistry::masterName(), isOfNode ? JournalEvent::Late : JournalEvent::Overrun);
    apply(Event::CyclesTripped, text);
}

/// Whether \a slot does the work of its node, or will in the next phase: a listener does none, nor does who has no cyclic channel yet.
bool QPlcMasterNodePrivate::takesPart(const NodeSlot &slot) const
{
    const Connection *connection = server->connectionOf(&slot);
    return !slot.listener && (slot.local || (connection && connection->isAttached()));
}

QString QPlcMasterNodePrivate::remainingCause() const
{
    if (state != QPlcMasterNode::SafeStop || m_culprit.isEmpty())
        return {};
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (slot->name != m_culprit || !takesPart(*slot))
            continue;
        return slot->bucket > 0 ? QStringLiteral("node '%1' still answers late, or not at all").arg(m_culprit)
                                : QString();
    }
    return m_mustReturn ? QStringLiteral("node '%1' is not back; start it again").arg(m_culprit) : QString();
}

bool QPlcMasterNodePrivate::reset()
{
    return apply(remainingCause().isEmpty() ? Event::Reset : Event::ResetTooEarly, QStringLiteral("reset"));
}

// ---- arming ----

bool QPlcMasterNodePrivate::arm()
{
    return prepare() && apply(Event::Arm);
}

bool QPlcMasterNodePrivate::isStartPermitted(quint64 token) const
{
    const bool isPermitted = arming.permits(token, qplc::monotonicNow());
    return isPermitted || (!isArmingRequired() && token == 0);
}

/// What the master knows of the state of a node.
QString QPlcMasterNodePrivate::stateOf(const NodeSlot &slot) const
{
    if (const auto local = localNode(&slot))
        return QString::fromLatin1(qplc::nameOf(local->state()));
    const Connection *connection = server->connectionOf(&slot);
    if (!connection)
        return {};
    QPlcSlaveNode::State known = QPlcSlaveNode::Registered;
    if (connection->hasFailed)
        known = QPlcSlaveNode::Fault;
    else if (connection->stage == Connection::Running)
        known = slot.isSafe ? QPlcSlaveNode::SafeStop : QPlcSlaveNode::RealTime;
    else if (connection->stage >= Connection::Initialized)
        known = QPlcSlaveNode::Ready;
    else if (connection->stage > Connection::Attached)
        known = QPlcSlaveNode::Initializing;
    return QString::fromLatin1(qplc::nameOf(known));
}

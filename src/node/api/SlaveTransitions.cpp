// SPDX-License-Identifier: Apache-2.0
// The states of QPlcSlaveNodePrivate: the table carried out.
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"

#include <utility>

using qplc::SlaveAction;
using qplc::SlaveEvent;
namespace messages = qplc::messages;

namespace {

/// Why a node that is in its phase goes to its safe state.
QPlcSlaveNode::SafeStateReason reasonOf(SlaveEvent event)
{
    return event == SlaveEvent::ConnectionLost  ? QPlcSlaveNode::MasterLost
        : event == SlaveEvent::WatchdogTimedOut ? QPlcSlaveNode::WatchdogReason
                                                : QPlcSlaveNode::PhaseEnded;
}

/// Ends the phase, if there is one: what the cycle thread still has to say comes before.
bool endsPhase(SlaveEvent event)
{
    switch (event) {
    case SlaveEvent::Leave:
    case SlaveEvent::ConnectionLost:
    case SlaveEvent::Refused:
    case SlaveEvent::MasterEnded:
    case SlaveEvent::PhaseStopped:
        return true;
    default:
        return false;
    }
}

}  // namespace

void QPlcSlaveNodePrivate::apply(SlaveEvent event, const Told &told)
{
    if (endsPhase(event))
        haltCycles(lastSent(told));
    const auto &cell = qplc::slaveStates().at(state, event);
    if (cell.verdict != qplc::Verdict::Accepted)
        return;
    const bool wasInPhase = m_inPhase;
    const bool hadChannel = hasChannel;
    if (event == SlaveEvent::PhaseStarted)
        m_isSafeTold = false;
    if (!localMaster && !prepareFor(cell.action, event, told))
        return;
    enter(cell.next);
    if (wasInPhase && !m_inPhase)
        Q_EMIT q->realTimeHasStopped();
    if (!wasInPhase && m_inPhase) {
        send(messages::RealTimeReady());
        Q_EMIT q->realTimeHasStarted();
    }
    if (hadChannel && !hasChannel)
        Q_EMIT q->disconnectedFromMaster();
    if (!localMaster && state == cell.next)
        carryOut(cell.action, told);
}

void QPlcSlaveNodePrivate::enter(QPlcSlaveNode::State newState)
{
    if (state == newState)
        return;
    state = newState;
    qCDebug(lcSlave) << name << newState;
    Q_EMIT q->stateChanged(newState);
}

/// What has to be done before the next state is there. \return false when it failed and has led to
/// another state
bool QPlcSlaveNodePrivate::prepareFor(SlaveAction action, SlaveEvent event, const Told &told)
{
    switch (action) {
    case SlaveAction::CloseConnection:
        m_retryTimer.stop();
        closeConnection(reasonOf(event));
        return true;
    case SlaveAction::CloseAndRetry:
        if (event == SlaveEvent::WatchdogTimedOut) {
            closeAfterWatchdog();
            return true;
        }
        closeConnection(reasonOf(event));
        retryLater(event);
        return true;
    case SlaveAction::EndCycles:
        endPhase(reasonOf(event));
        return true;
    case SlaveAction::TakeValues:
        return initializeWith(std::get<messages::InitializeWithValues>(told));
    case SlaveAction::StartCycles:
        return startCycles(std::get<messages::RealTimeStarted>(told));
    default:
        return true;
    }
}

/// What is done in the state that has been reached.
void QPlcSlaveNodePrivate::carryOut(SlaveAction action, const Told &told)
{
    switch (action) {
    case SlaveAction::OpenConnection:
        openConnection();
        break;
    case SlaveAction::Greet:
        greet();
        break;
    case SlaveAction::Proceed:
        if (const auto *registered = std::get_if<messages::Registered>(&told))
            proceedAfterRegistered(*registered);
        else
            proceedAfterHello();
        break;
    case SlaveAction::TellRegistered:
        tellRegistered();
        break;
    case SlaveAction::GiveOutputs:
        sendInitialOutputs(std::get<messages::SendYourInitialOutputStates>(told));
        break;
    default:
        break;
    }
}

void QPlcSlaveNodePrivate::makeSafe(QPlcSlaveNode::SafeStateReason reason)
{
    runtime.makeSafe(reason);
    tellSafe(reason);
}

void QPlcSlaveNodePrivate::tellSafe(QPlcSlaveNode::SafeStateReason reason)
{
    if (!std::exchange(m_isSafeTold, true))
        Q_EMIT q->safeStateEntered(reason);
}

// ---- each cycle ----

void QPlcSlaveNodePrivate::watchCycles()
{
    if (m_cycleNotifier)
        return;
    qplc::WakeUp &wakeUp = runtime.stepWakeUp();
    if (!wakeUp.isValid()) {
        qCWarning(lcSlave).noquote() << "realTimedOut() is not emitted:" << wakeUp.errorString();
        return;
    }
    m_cycleNotifier = new QSocketNotifier(wakeUp.descriptor(), QSocketNotifier::Read, q);
    QObject::connect(m_cycleNotifier, &QSocketNotifier::activated, q, [this, &wakeUp] {
        wakeUp.consume();
        wakeUp.arm();  // before the reader looks: a cycle that comes meanwhile tells again
        Q_EMIT q->realTimedOut();
    });
    wakeUp.arm();
}

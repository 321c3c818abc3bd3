// SPDX-License-Identifier: Apache-2.0
// The phases of QPlcSlaveNodePrivate: initialization, cycles and their reports, and what the
// profile of the plant says about them.
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/cycle/FrameLog.h"
#include "node/cycle/PeriodRange.h"
#include "node/cycle/ProfileDefaults.h"
#include "realtime/TimeSource.h"

#include <QtCore/QMetaMethod>

#include <algorithm>

using qplc::SlaveEvent;
namespace messages = qplc::messages;

namespace {

QPlcClock clockOf(const messages::RealTimeStarted &start)
{
    switch (start.clock) {
    case messages::ClockKind::Lockstep:
        return QPlcClock::lockstep();
    case messages::ClockKind::External:
        return QPlcClock::external();
    case messages::ClockKind::Scaled:
        return QPlcClock::scaled(start.scale);
    case messages::ClockKind::RealTime:
        break;
    }
    return QPlcClock::realTime();
}

/// What a node cannot compute with of a phase that its master begins; empty: nothing.
QString phaseError(const messages::RealTimeStarted &start)
{
    if (start.period < qplc::ShortestPeriod || start.period > qplc::LongestPeriod)
        return QStringLiteral("a period of %1 s is out of range; use 0.00001 ... 10 s")
            .arg(double(start.period.count()) * 1e-9);
    const QPlcClock clock = clockOf(start);
    if (!clock.isValid())
        return QStringLiteral("a clock of %1 times real time is out of range; use 0.001 ... 1000, or lockstep")
            .arg(clock.scale());
    const quint64 first = start.firstCycle - start.cycleZero;
    if (first >= qplc::mostCycles(start.period))
        return QStringLiteral("it begins with cycle %1, which has no time").arg(qint64(first));
    return {};
}

/// Where the inputs lie in datagrams for many nodes; what is out of place is refused by its size of
/// 0, and no frame will fit.
qplc::SlaveCycle::Group groupOf(const std::optional<messages::GroupPlace> &place, const qplc::PayloadLayout &inputs)
{
    if (!place || place->offset < 2 || place->size > int(qplc::MaximumCyclicPayload)
        || qint64(place->offset) + qint64(inputs.size()) > place->size)
        return {};
    return {std::uint16_t(place->part), std::uint32_t(place->offset), std::uint32_t(place->size), place->hash};
}

}  // namespace

/// The code of the derived class threw: the master is told, and the node waits in its safe state
/// for the next initialization.
/// \param phase  cycleZero of the phase in whose cycles it threw
void QPlcSlaveNodePrivate::codeFailed(const QString &text, const std::optional<messages::Hex64> &phase)
{
    send(messages::NodeFault{text, phase});
    makeSafe(QPlcSlaveNode::CodeFailed);
    apply(SlaveEvent::CodeFailed);
    setError(QPlcSlaveNode::UserCodeError, QStringLiteral("node '%1': %2").arg(name, text));
}

/// Whether the node has been in the phase that \a request names, and has lost nothing but the
/// connection.
bool QPlcSlaveNodePrivate::canGoOn(const messages::SendYourInitialOutputStates &request) const
{
    return request.phase && m_lastPhase == PhaseName{control.master().session, *request.phase};
}

void QPlcSlaveNodePrivate::sendInitialOutputs(const messages::SendYourInitialOutputStates &request)
{
    QString text;
    m_goesOn = canGoOn(request);
    if (m_goesOn) {
        runtime.goOn();
    } else if (!runtime.reset(&text)) {
        codeFailed(text);
        return;
    }
    const QByteArray values(runtime.outputs(), int(runtime.outputLayout().size()));
    send(messages::ReceiveMyInitialOutputStates{values, m_goesOn});
}

bool QPlcSlaveNodePrivate::initializeWith(const messages::InitializeWithValues &initial)
{
    const QByteArray &values = initial.values;
    if (values.size() != int(runtime.inputLayout().size())) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("node '%1': initial values of %2 bytes instead of %3")
                   .arg(name)
                   .arg(values.size())
                   .arg(runtime.inputLayout().size()));
        return false;
    }
    QString text;
    if (m_goesOn) {
        runtime.storeInputs(values.constData());
    } else if (!runtime.initialize(values.constData(), &text)) {
        codeFailed(text);
        return false;
    }
    send(messages::Initialized());
    if (!m_goesOn)
        tellInitialized();
    return true;
}

void QPlcSlaveNodePrivate::tellInitialized()
{
    if (q->isSignalConnected(QMetaMethod::fromSignal(&QPlcSlaveNode::hasInitialized)))
        Q_EMIT q->hasInitialized(qplc::NodeRuntime::toList(runtime.inputLayout(), runtime.inputs()));
}

bool QPlcSlaveNodePrivate::refusePhase(QPlcSlaveNode::Error reason, const QString &text)
{
    send(messages::NodeFault{text, {}});
    setError(reason, QStringLiteral("node '%1': %2").arg(name, text));
    return false;
}

bool QPlcSlaveNodePrivate::startCycles(const messages::RealTimeStarted &start)
{
    const QString wrong = phaseError(start);
    if (!wrong.isEmpty())
        return refusePhase(QPlcSlaveNode::ProtocolError,
                           QStringLiteral("the phase that the master begins is refused: %1").arg(wrong));
    qplc::SlaveCycle::Phase phase;
    phase.period = start.period;
    phase.clock = clockOf(start);
    phase.cycleZero = start.cycleZero;
    phase.firstCycle = start.firstCycle;
    phase.group = groupOf(start.group, runtime.inputLayout());
    phase.interval = interval;
    phase.realTimeOptions = realTimeOptions;
    // Whatever else a master tells, or does not tell, the strict one holds.
    const bool isSimulation = start.profile == QPlcProfile::name(QPlcProfile::Simulation);
    phaseProfile = isSimulation ? QPlcProfile::Simulation : QPlcProfile::Plant;
    applyProfile(&phase);
    if (!cycle->start(phase))
        return refusePhase(QPlcSlaveNode::OptionError, cycle->errorString());
    for (const QPlcRealTimeSetting &setting : cycle->realTimeSettings()) {
        if (!setting.granted)
            qCWarning(lcSlave).noquote() << "node" << name << setting.toString();
    }
    m_inPhase = true;
    m_goesOn = false;
    m_lastPhase = PhaseName{control.master().session, phase.cycleZero};
    ++m_phase;
    return true;
}

/// Sets what the profile of the plant says, unless the node says otherwise.
void QPlcSlaveNodePrivate::applyProfile(qplc::SlaveCycle::Phase *phase)
{
    using Reaction = QPlcSlaveNode::WatchdogReaction;
    const qplc::ProfileDefaults &defaults = qplc::ProfileDefaults::of(phaseProfile);
    const auto time = watchdog.value_or(listener ? std::chrono::nanoseconds(0) : defaults.watchdog);
    const int periods = watchdog ? watchdogPeriods : defaults.watchdogPeriods;
    watchdogOfPhase
        = time.count() > 0 ? std::max(time, periods * interval.cycles() * phase->period) : std::chrono::nanoseconds(0);
    phase->watchdog = watchdogOfPhase;
    phase->isSafeByWatchdog = m_isSafeByWatchdog = watchdogReaction.value_or(defaults.reaction) == Reaction::SafeState;
    phase->usualHold = defaults.hold;
}

/// What the master says to have sent to the node, at the end of the phase.
std::optional<qplc::SentCycles::Last> QPlcSlaveNodePrivate::lastSent(const Told &told)
{
    const auto *stop = std::get_if<messages::RealTimeStopped>(&told);
    if (!stop || !stop->lastCycle)
        return {};
    return qplc::SentCycles::Last{*stop->lastCycle, std::uint16_t(stop->before)};
}

/// \param last  what the master has sent; none: it is not known
void QPlcSlaveNodePrivate::haltCycles(const std::optional<qplc::SentCycles::Last> &last)
{
    if (!m_inPhase)
        return;
    m_rest.stop();
    cycle->stop(last);
    takeReports();
}

/// A listener without devices has nothing to bring to rest: it takes what the master has sent,
/// which the stop may have overtaken, and ends its phase then.
void QPlcSlaveNodePrivate::stopPhase(const messages::RealTimeStopped &stop)
{
    if (!m_inPhase || !listener || hardware || !stop.lastCycle) {
        apply(SlaveEvent::PhaseStopped, stop);
        return;
    }
    m_stopTold = stop;
    m_rest.start();
    lookForRest();
}

void QPlcSlaveNodePrivate::lookForRest()
{
    if (cycle->hasEnded())
        endRest();
    else
        cycle->finish(*lastSent(m_stopTold));
}

/// Ends the phase that the master has stopped, whatever is there of its rest.
void QPlcSlaveNodePrivate::endRest()
{
    if (m_rest.isActive())
        apply(SlaveEvent::PhaseStopped, m_stopTold);
}

/// \pre haltCycles()
void QPlcSlaveNodePrivate::endPhase(QPlcSlaveNode::SafeStateReason reason)
{
    if (!m_inPhase)
        return;
    m_inPhase = false;
    if (const auto untold = m_watchdogReports.take(name))
        qCWarning(lcSlave).noquote() << untold->text;
    if (runtime.hasFailed())
        m_lastPhase.reset();
    makeSafe(reason);
    runtime.stopped();
}

void QPlcSlaveNodePrivate::takeReports()
{
    if (!cycle)
        return;
    cycle->reports().take([this](const qplc::CycleEvent &event) { report(event); },
                          [this](const qplc::TappedFrame &frame) { qplc::logFrame(name, frame); });
}

void QPlcSlaveNodePrivate::watchdogHasTimedOut(quint64 lastCycle)
{
    const QString text = QStringLiteral("node '%1': no frame of the master for %2 ms since cycle %3")
                             .arg(name)
                             .arg(double(watchdogOfPhase.count()) * 1e-6)
                             .arg(lastCycle);
    if (m_isSafeByWatchdog) {
        tellSafe(QPlcSlaveNode::WatchdogReason);
        apply(SlaveEvent::WatchdogTimedOut);
        setError(QPlcSlaveNode::WatchdogError, text + QStringLiteral(": safe state"));
    } else if (const auto told = m_watchdogReports.report(name, text, {}, qplc::monotonicNow())) {
        qCWarning(lcSlave).noquote() << told->text;
    }
    Q_EMIT q->watchdogTimedOut(lastCycle);
}

void QPlcSlaveNodePrivate::report(const qplc::CycleEvent &event)
{
    switch (event.kind) {
    case qplc::CycleEvent::ToldSafeStop:
        qCWarning(lcSlave).noquote() << "node" << name << "- the master stops safely, in cycle" << event.cycle;
        tellSafe(QPlcSlaveNode::MasterStopsSafely);
        apply(SlaveEvent::ToldSafeStop);
        break;
    case qplc::CycleEvent::WatchdogTimedOut:
        watchdogHasTimedOut(event.cycle);
        break;
    case qplc::CycleEvent::NodeFaulted:
        codeFailed(QStringLiteral("the code of the node threw in cycle %1: %2")
                       .arg(event.cycle)
                       .arg(QString::fromLocal8Bit(runtime.faultText())),
                   m_lastPhase ? std::optional<messages::Hex64>(m_lastPhase->cycleZero) : std::nullopt);
        break;
    case qplc::CycleEvent::ForgedFrame:
        qCWarning(lcSlave).noquote() << "node" << name
                                     << "drops frames that are not as its master seals them, since cycle" << event.cycle
                                     << "- somebody else sends them, or they are changed on the way";
        break;
    case qplc::CycleEvent::LinkClosed:
        qCDebug(lcSlave).noquote()
            << "node" << name << "has lost its cyclic connection";  // the control connection follows, with the reason
        break;
    default:
        break;
    }
}

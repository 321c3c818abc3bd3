// SPDX-License-Identifier: Apache-2.0
// The sequences of QPlcMasterNodePrivate: initialization, start, stop, and the node that joins while others run.
#include "Logging.h"
#include "MasterReplies.h"
#include "QPlcMasterNodePrivate.h"
#include "QPlcSlaveNodePrivate.h"

#include <algorithm>

using Message = QPlcMessage;
using qplc::NodeSlot;

// ---- initialization ----

bool QPlcMasterNodePrivate::initializeAllStates()
{
    if (!prepare())
        return false;
    if (state != QPlcMasterNode::Off)
        return setError(QPlcMasterNode::StateError,
                        QStringLiteral("states can only be initialized while the master is off; stop it first"));
    error = QPlcMasterNode::NoError;
    errorString.clear();
    m_startAfterwards = false;
    setState(QPlcMasterNode::Initializing);
    collectOutputs();
    return error == QPlcMasterNode::NoError;
}

/// Every node that is waited for now owes the answer that brings it to stage \a owed.
void QPlcMasterNodePrivate::begin(Step step, Connection::Stage owed)
{
    m_step = step;
    m_owed = owed;
    for (Connection *connection : m_participants)
        connection->stage = Connection::Stage(owed - 1);
    stepTimer.start();
}

/// Goes on to the next step when nobody owes an answer any more.
void QPlcMasterNodePrivate::advance()
{
    const auto done = [this](const Connection *connection) { return connection->stage >= m_owed; };
    if (m_step == Step::None || !std::all_of(m_participants.begin(), m_participants.end(), done))
        return;
    stepTimer.stop();
    switch (m_step) {
    case Step::CollectOutputs:
        distributeInputs();
        break;
    case Step::DistributeInputs:
        initializationEnded();
        break;
    case Step::Start:
        startCycles();
        break;
    case Step::None:
        break;
    }
}

/// A node answers the step at hand; anything else from it comes at the wrong time.
void QPlcMasterNodePrivate::continueSequence(Connection *connection, const Message &message)
{
    const Message::Kind expected = m_step == Step::CollectOutputs ? Message::ReceiveMyInitialOutputStates
        : m_step == Step::DistributeInputs                        ? Message::Initialized
        : m_step == Step::Start                                   ? Message::RealTimeReady
                                                                  : Message::Invalid;
    if (message.kind() != expected || connection->stage + 1 != m_owed) {
        connection->fail(QStringLiteral("WrongState"), QStringLiteral("%1 was not asked for").arg(message.kindName()));
        return;
    }
    if (m_step == Step::CollectOutputs && !storeOutputs(connection, message))
        return;
    connection->stage = m_owed;
    advance();
}

void QPlcMasterNodePrivate::collectOutputs()
{
    cycle->forgetOutputs();
    statisticSignals.reset(cycle.get());
    m_participants.clear();
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->isAttached() && !connection->slot->listener)
            m_participants.push_back(connection.get());
    }
    begin(Step::CollectOutputs, Connection::OutputsGiven);
    for (Connection *listener : listeners())
        join(listener);
    for (Connection *connection : m_participants)
        connection->send(Message::SendYourInitialOutputStates);
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (!slot->local)
            continue;
        QString text;
        slot->local->node().d->setState(QPlcSlaveNode::Initializing);
        if (!slot->local->reset(&text)) {
            abortSequence(QStringLiteral("node '%1': %2").arg(slot->name, text));
            return;
        }
        if (!takeOutputs(*slot, slot->local->outputs()))
            return;
    }
    advance();
}

/// What is wrong with the initial outputs of a node; empty: nothing.
QString QPlcMasterNodePrivate::faultOfOutputs(const NodeSlot &slot, const char *outputs) const
{
    for (const qplc::SignalGuard::Frame::Field &field : slot.outputs.fields) {
        const qplc::ValueFault fault = slot.outputs.rules.fault(field.number, outputs);
        const QPlcSignalDefinition &signal = table.at(QPlcSignalIndex(field.place));
        if (fault)
            return QStringLiteral("the initial value of signal '%1': %2")
                .arg(signal.name, qplc::faultText(signal, fault));
    }
    return {};
}

bool QPlcMasterNodePrivate::takeOutputs(NodeSlot &slot, const char *outputs)
{
    const QString fault = faultOfOutputs(slot, outputs);
    if (!fault.isEmpty()) {
        abortSequence(QStringLiteral("node '%1': %2").arg(slot.name, fault));
        return false;
    }
    cycle->takeInitialOutputs(slot, outputs, leaseBooks.mask());
    return true;
}

/// Takes the initial outputs of a node. \return false when the message has the wrong size
bool QPlcMasterNodePrivate::storeOutputs(Connection *connection, const Message &message)
{
    const QByteArray values = message.bytes(QStringLiteral("values"));
    if (values.size() != int(connection->slot->outputLayout.size())) {
        server->drop(connection,
                     QStringLiteral("it sent %1 bytes of initial outputs instead of %2")
                         .arg(values.size())
                         .arg(connection->slot->outputLayout.size()));
        return false;
    }
    NodeSlot &slot = *connection->slot;
    slot.initialOutputs.assign(values.begin(), values.end());
    if (!isRunning() && !slot.listener)
        return takeOutputs(slot, values.constData());
    const QString fault = faultOfOutputs(slot, values.constData());
    if (!fault.isEmpty()) {
        server->drop(connection, fault);
        return false;
    }
    if (!isRunning())
        cycle->takeInitialOutputs(slot, values.constData(), leaseBooks.mask());
    return true;
}

void QPlcMasterNodePrivate::sendInitialInputs(const Connection *connection)
{
    const QByteArray values = cycle->gather(connection->slot->inputRuns, connection->slot->inputLayout.size());
    connection->send(Message::InitializeWithValues, {{QStringLiteral("values"), Message::fromBytes(values)}});
}

void QPlcMasterNodePrivate::distributeInputs()
{
    qplc::Roster roster;
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (slot->local || slot->peer)
            roster.nodes.push_back(slot);
    }
    roster.held = leaseBooks.mask();
    cycle->initialOutputsTaken(roster);
    begin(Step::DistributeInputs, Connection::Initialized);
    for (const Connection *connection : m_participants)
        sendInitialInputs(connection);
    for (Connection *listener : listeners())
        goOn(listener);
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (!slot->local)
            continue;
        QString text;
        const QByteArray values = cycle->gather(slot->inputRuns, slot->inputLayout.size());
        if (!slot->local->initialize(values.constData(), &text)) {
            abortSequence(QStringLiteral("node '%1': %2").arg(slot->name, text));
            return;
        }
        slot->local->node().d->setState(QPlcSlaveNode::Off);
        slot->local->node().d->tellInitialized();
    }
    advance();
}

void QPlcMasterNodePrivate::initializationEnded()
{
    m_initialized = true;
    m_step = Step::None;
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage >= Connection::Greeted)
            connection->send(Message::StatesInitialized, {{QStringLiteral("ok"), true}});
    }
    Q_EMIT q->statesInitialized();
    if (m_startAfterwards) {
        beginStart();
        return;
    }
    setState(QPlcMasterNode::Off);
    answerRequester(true, {});
}

void QPlcMasterNodePrivate::stepTimedOut()
{
    QStringList names;
    for (const Connection *connection : m_participants) {
        if (connection->stage < m_owed)
            names << QStringLiteral("'%1'").arg(connection->name);
    }
    const QString what = m_step == Step::Start ? QStringLiteral("RealTimeStarted")
        : m_step == Step::CollectOutputs       ? QStringLiteral("SendYourInitialOutputStates")
                                               : QStringLiteral("InitializeWithValues");
    abortSequence(QStringLiteral("no answer to %1 within %2 ms from node %3; is it busy, or stopped?")
                      .arg(what)
                      .arg(stepTimer.interval())
                      .arg(names.join(QStringLiteral(", "))));
}

void QPlcMasterNodePrivate::abortSequence(const QString &reason)
{
    stepTimer.stop();
    const bool wasStarting = m_step == Step::Start;
    m_step = Step::None;
    m_initialized = false;
    const Message initializationFailed(Message::StatesInitialized,
                                       {{QStringLiteral("ok"), false}, {QStringLiteral("text"), reason}});
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (wasStarting && connection->stage > Connection::Attached)
            connection->send(Message::RealTimeStopped, {{QStringLiteral("reason"), reason}});
        else if (!wasStarting && connection->stage >= Connection::Greeted)
            connection->socket->sendMessage(initializationFailed);
        connection->stage = std::min(connection->stage, Connection::Attached);
    }
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (slot->local)
            slot->local->node().d->setState(QPlcSlaveNode::Off);
    }
    m_participants.clear();
    setState(QPlcMasterNode::Off);
    setError(QPlcMasterNode::InitializationError, reason);
    answerRequester(false, reason);
}

// ---- start ----

bool QPlcMasterNodePrivate::startRealTime(quint64 cycles)
{
    if (!prepare())
        return false;
    if (state != QPlcMasterNode::Off)
        return setError(
            QPlcMasterNode::StateError,
            QStringLiteral("the real-time phase can only be started while the master is off; stop it first"));
    const QString optionError = realTimeOptions.errorString();
    if (!optionError.isEmpty())
        return setError(QPlcMasterNode::RealTimeError, optionError);
    error = QPlcMasterNode::NoError;
    errorString.clear();
    m_cyclesWanted = cycles;
    m_startAfterwards = true;
    setState(QPlcMasterNode::Initializing);
    if (m_initialized)
        beginStart();
    else
        collectOutputs();
    return error == QPlcMasterNode::NoError;
}

QJsonObject QPlcMasterNodePrivate::startFields(const NodeSlot &slot) const
{
    QJsonObject fields{
        {QStringLiteral("period"), double(interval.count())},
        {QStringLiteral("clock"), qplc::clockName(clock)},
        {QStringLiteral("scale"), clock.scale()},
        {QStringLiteral("cycleZero"), Message::fromHex64(cycle->cycleZero())},
        {QStringLiteral("firstCycle"), Message::fromHex64(cycle->cycleZero() + (isRunning() ? cycle->cycle() : 0))}};
    if (slot.multicast)
        fields.insert(QStringLiteral("group"),
                      QJsonObject{{QStringLiteral("part"), slot.multicast->number},
                                  {QStringLiteral("offset"), double(slot.multicastOffset)},
                                  {QStringLiteral("size"), double(slot.multicast->payloadSize)},
                                  {QStringLiteral("hash"), Message::fromHex64(slot.multicast->hash)}});
    return fields;
}

void QPlcMasterNodePrivate::beginStart()
{
    begin(Step::Start, Connection::Running);
    std::vector<Connection *> told = m_participants;
    for (Connection *listener : listeners()) {
        if (listener->stage != Connection::Initialized)
            continue;  // it has not come so far: goOn()
        listener->stage = Connection::Starting;
        told.push_back(listener);
    }
    m_multicastParts.restart(session, server->multicastGroup());
    for (Connection *connection : told) {
        if (connection->slot->wantsMulticast)
            m_multicastParts.add(*connection->slot);
    }
    m_multicastParts.finish();
    for (const Connection *connection : told)
        connection->send(Message::RealTimeStarted, startFields(*connection->slot));
    advance();
}

void QPlcMasterNodePrivate::startCycles()
{
    m_step = Step::None;
    qplc::MasterCycle::Phase phase;
    phase.period = interval;
    phase.clock = clock;
    phase.overrunPolicy = overrunPolicy;
    phase.cycleLimit = m_cyclesWanted > 0 ? m_cyclesWanted : cycleLimit;
    phase.timeSignal = timeSignal;
    phase.jitterSignal = jitterSignal;
    phase.workloadSignal = workloadSignal;
    phase.realTimeOptions = realTimeOptions;
    giveRoster();
    if (!cycle->start(phase)) {
        m_step = Step::Start;
        abortSequence(cycle->errorString());
        return;
    }
    for (const QPlcRealTimeSetting &setting : cycle->realTimeSettings()) {
        if (!setting.granted)
            journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::State, qplc::NodeRegistry::masterName(),
                         setting.toString());
    }
    m_participants.clear();
    m_goneListeners.clear();
    m_abandoned.clear();
    statisticSignals.start(cycle.get(), registry.get(), clock.isLockstep());
    journal.watchOverruns(&cycle->cycleStatistics());
    setState(QPlcMasterNode::RealTime);
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (!slot->local)
            continue;
        slot->local->node().d->setState(QPlcSlaveNode::RealTime);
        Q_EMIT slot->local->node().realTimeHasStarted();
    }
    Q_EMIT q->realTimeHasStarted();
    answerRequester(true, {});
    // Whoever attached while the others were being started joins now.
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage == Connection::Attached)
            join(connection.get());
    }
}

/// Nodes of the cycle: those of this process, and those over the network that are ready.
void QPlcMasterNodePrivate::giveRoster()
{
    qplc::Roster roster;
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        const Connection *connection = slot->local ? nullptr : server->connectionOf(slot.get());
        if (slot->local || (connection && connection->stage == Connection::Running))
            roster.nodes.push_back(slot);
    }
    roster.held = leaseBooks.mask();
    for (const QPlcSignalIndex signal : qAsConst(m_abandoned)) {
        if (registry->writer(signal).isEmpty())
            roster.abandoned.push_back(signal);
    }
    cycle->setRoster(roster);
}

// ---- stop ----

void QPlcMasterNodePrivate::stop(const QString &reason)
{
    if (m_step != Step::None)
        abortSequence(QStringLiteral("stopped: %1").arg(reason));
    if (!isRunning())
        return;
    cycle->stop();
    statisticSignals.stop();
    journal.watchOverruns(nullptr);
    m_initialized = false;
    setState(QPlcMasterNode::Off, reason);
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage <= Connection::Attached)
            continue;
        connection->send(Message::RealTimeStopped, {{QStringLiteral("reason"), reason}});
        connection->stage = Connection::Attached;
    }
    cycle->setRoster({});
    for (const std::shared_ptr<NodeSlot> &slot : registry->nodes()) {
        if (!slot->local)
            continue;
        slot->local->stopped();
        slot->local->node().d->setState(QPlcSlaveNode::Off);
        Q_EMIT slot->local->node().realTimeHasStopped();
    }
    takeReports();
    Q_EMIT q->realTimeHasStopped();
}

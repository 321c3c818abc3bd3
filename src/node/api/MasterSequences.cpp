// SPDX-License-Identifier: Apache-2.0
// The sequences of QPlcMasterNodePrivate: initialization, start, stop, and the node that joins while others run.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"

#include <algorithm>
#include <utility>

using Event = qplc::MasterEvent;
using Message = QPlcMessage;
using qplc::NodeSlot;
using LocalNodes = std::vector<std::shared_ptr<qplc::LocalNode>>;

// ---- profile ----

/// Whether a phase has begun, with its initialization: its profile stays.
bool QPlcMasterNodePrivate::hasFixedProfile() const
{
    return m_isRunning || m_step != Step::None;
}

qplc::ChosenProfile QPlcMasterNodePrivate::profile() const
{
    return hasFixedProfile() ? m_profile : profileForNow();
}

qplc::ChosenProfile QPlcMasterNodePrivate::profileForNow() const
{
    qplc::ProfileFacts facts;
    facts.wanted = profileWanted;
    facts.isLockstep = clock.isLockstep();
    if (server && server->port() != 0 && !server->address().isLoopback())
        facts.networkAddress = server->address().toString();
    if (registry) {
        const auto &nodes = registry->nodes();
        const auto found = std::find_if(nodes.begin(), nodes.end(),
                                        [](const std::shared_ptr<NodeSlot> &slot) { return slot->hardware; });
        if (found != nodes.end())
            facts.hardwareNode = (*found)->name;
    }
    return qplc::chooseProfile(facts);
}

void QPlcMasterNodePrivate::fixProfile()
{
    const qplc::ChosenProfile chosen = profileForNow();
    const bool isNew = !(chosen == m_profile);
    m_profile = chosen;
    if (isNew)
        journal.tell(qplc::JournalEvent::Info, qplc::JournalEvent::State, qplc::NodeRegistry::masterName(),
                     QStringLiteral("profile %1: %2").arg(QPlcProfile::name(chosen.value), chosen.reason));
}

/// Real devices take no part in a phase that forgives what is late or lost.
qplc::Refusal QPlcMasterNodePrivate::objectionTo(const qplc::NodeDeclaration &node) const
{
    if (!node.hardware || !hasFixedProfile() || m_profile.value != QPlcProfile::Simulation)
        return {};
    return {QStringLiteral("ProfileMismatch"),
            QStringLiteral("node '%1' drives real devices, and the phase at hand has the profile Simulation (%2); stop "
                           "it and start again with this node")
                .arg(node.name, m_profile.reason)};
}

// ---- initialization ----

bool QPlcMasterNodePrivate::initializeAllStates()
{
    return prepare() && apply(Event::Initialize) && error == QPlcMasterNode::NoError;
}

/// Every node that is waited for now owes the answer that brings it to stage \a owed.
/// \return the number of the step, for isStill()
quint64 QPlcMasterNodePrivate::begin(Step step, Connection::Stage owed)
{
    m_step = step;
    m_owed = owed;
    for (Connection *connection : m_participants) {
        connection->stage = Connection::Stage(owed - 1);
        connection->hasFailed = connection->hasFailed && step != Step::CollectOutputs;
    }
    stepTimer.start();
    return ++m_stepNumber;
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
void QPlcMasterNodePrivate::continueSequence(Connection *connection, Message::Kind answer, const QByteArray &outputs)
{
    const Message::Kind expected = m_step == Step::CollectOutputs ? Message::ReceiveMyInitialOutputStates
        : m_step == Step::DistributeInputs                        ? Message::Initialized
        : m_step == Step::Start                                   ? Message::RealTimeReady
                                                                  : Message::Invalid;
    if (answer != expected || connection->stage + 1 != m_owed) {
        connection->fail(QStringLiteral("WrongState"),
                         QStringLiteral("%1 was not asked for").arg(Message(answer).kindName()));
        return;
    }
    if (m_step == Step::CollectOutputs && !storeOutputs(connection, outputs))
        return;
    connection->stage = m_owed;
    advance();
}

void QPlcMasterNodePrivate::collectOutputs()
{
    error = QPlcMasterNode::NoError;
    errorString.clear();
    fixProfile();
    cycle->forgetOutputs(defaults().hold);
    statisticSignals.reset(cycle.get());
    m_participants.clear();
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->isAttached() && !connection->slot->listener)
            m_participants.push_back(connection.get());
    }
    const quint64 step = begin(Step::CollectOutputs, Connection::OutputsGiven);
    for (Connection *listener : listeners())
        join(listener);
    for (Connection *connection : m_participants)
        connection->send(qplc::messages::SendYourInitialOutputStates());
    for (const auto &node : LocalNodes(m_localNodes)) {
        QString text;
        const bool isThere = node->askOutputs(&text);
        if (!isStill(step))
            return;  // who heard of it has ended the sequence
        if (!isThere) {
            sequenceFailed(QStringLiteral("node '%1': %2").arg(node->slot()->name, text));
            return;
        }
        if (!takeOutputs(*node->slot(), node->runtime().outputs()))
            return;
    }
    advance();
}

/// What is wrong with the initial outputs of a node; empty: nothing.
QString QPlcMasterNodePrivate::faultOfOutputs(const NodeSlot &slot, const char *outputs) const
{
    for (const qplc::SignalGuard::Frame::Field &field : slot.outputs.fields) {
        const qplc::ValueFault fault = slot.outputs.fault(field, outputs);
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
        sequenceFailed(QStringLiteral("node '%1': %2").arg(slot.name, fault));
        return false;
    }
    cycle->takeInitialOutputs(slot, outputs, leaseBooks.mask());
    return true;
}

/// Takes the initial outputs of a node. \return false when the message has the wrong size
bool QPlcMasterNodePrivate::storeOutputs(Connection *connection, const QByteArray &values)
{
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
    connection->send(qplc::messages::InitializeWithValues{values});
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
    const quint64 step = begin(Step::DistributeInputs, Connection::Initialized);
    for (const Connection *connection : m_participants)
        sendInitialInputs(connection);
    for (Connection *listener : listeners())
        goOn(listener);
    for (const auto &node : LocalNodes(m_localNodes)) {
        QString text;
        const NodeSlot &slot = *node->slot();
        const bool hasTaken = node->giveInputs(cycle->gather(slot.inputRuns, slot.inputLayout.size()), &text);
        if (!isStill(step))
            return;  // who heard of it has ended the sequence
        if (!hasTaken) {
            sequenceFailed(QStringLiteral("node '%1': %2").arg(slot.name, text));
            return;
        }
    }
    advance();
}

void QPlcMasterNodePrivate::initializationEnded()
{
    m_step = Step::None;
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage >= Connection::Greeted)
            connection->send(qplc::messages::StatesInitialized{true, {}});
    }
    Q_EMIT q->statesInitialized();
    if (m_startAfterwards) {
        beginStart();
        return;
    }
    apply(Event::StatesInitialized);
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
    sequenceFailed(QStringLiteral("no answer to %1 within %2 ms from node %3; is it busy, or stopped?")
                       .arg(what)
                       .arg(stepTimer.interval())
                       .arg(names.join(QStringLiteral(", "))));
}

void QPlcMasterNodePrivate::sequenceFailed(const QString &reason)
{
    apply(Event::SequenceFailed, reason);
}

void QPlcMasterNodePrivate::endSequence(const QString &reason)
{
    stepTimer.stop();
    const bool wasStarting = m_step == Step::Start;
    m_step = Step::None;
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (wasStarting && connection->stage > Connection::Attached)
            connection->send(qplc::messages::RealTimeStopped{reason});
        else if (!wasStarting && connection->stage >= Connection::Greeted)
            connection->send(qplc::messages::StatesInitialized{false, reason});
        connection->stage = std::min(connection->stage, Connection::Attached);
    }
    for (const auto &node : LocalNodes(m_localNodes))
        node->initializationFailed();
    m_participants.clear();
    setError(QPlcMasterNode::InitializationError, reason);
    answerRequester(false, reason);
}

// ---- start ----

bool QPlcMasterNodePrivate::startRealTime(quint64 cycles, bool isPermitted)
{
    if (!prepare())
        return false;
    const QString optionError = realTimeOptions.errorString();
    if (!optionError.isEmpty())
        return setError(QPlcMasterNode::RealTimeError, optionError);
    const quint64 cyclesOfThisPhase = std::exchange(m_cyclesWanted, cycles);
    if (apply(isPermitted ? Event::Start : Event::StartUnarmed))
        return error == QPlcMasterNode::NoError;
    m_cyclesWanted = cyclesOfThisPhase;
    return false;
}

qplc::messages::RealTimeStarted QPlcMasterNodePrivate::startOf(const NodeSlot &slot) const
{
    qplc::messages::RealTimeStarted message;
    message.period = interval;
    message.clock = qplc::clockKindOf(clock);
    message.scale = clock.scale();
    message.profile = QPlcProfile::name(m_profile.value);
    message.cycleZero = cycle->cycleZero();
    message.firstCycle = cycle->cycleZero() + (isRunning() ? cycle->cycle() : 0);
    if (slot.multicast)
        message.group = qplc::messages::GroupPlace{int(slot.multicast->number), int(slot.multicastOffset),
                                                   int(slot.multicast->payloadSize), slot.multicast->hash};
    return message;
}

void QPlcMasterNodePrivate::beginStart()
{
    error = QPlcMasterNode::NoError;
    errorString.clear();
    fixProfile();  // again: what it depends on may have been set since the initialization
    begin(Step::Start, Connection::Running);
    std::vector<Connection *> told = m_participants;
    for (Connection *listener : listeners()) {
        if (listener->stage != Connection::Initialized)
            continue;  // it has not come so far: goOn()
        listener->stage = Connection::Starting;
        told.push_back(listener);
    }
    m_multicastParts.restart(session, hub);
    for (Connection *connection : told) {
        if (connection->slot->isInGroup())
            m_multicastParts.add(*connection->slot);
    }
    m_multicastParts.finish();
    for (const Connection *connection : told)
        connection->send(startOf(*connection->slot));
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
    phase.gapLimit = gapLimit.value_or(defaults().gapLimit);
    phase.longestWait = longestWait.value_or(defaults().longestWait);
    phase.usualHold = defaults().hold;
    phase.overrunLimit = overrunLimit;
    m_written.clear();
    giveRoster();
    if (!cycle->start(phase)) {
        m_step = Step::Start;
        apply(Event::ThreadFailed, cycle->errorString());
        return;
    }
    m_isRunning = true;
    for (const QPlcRealTimeSetting &setting : cycle->realTimeSettings()) {
        if (!setting.granted)
            journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::State, qplc::NodeRegistry::masterName(),
                         setting.toString());
    }
    m_participants.clear();
    m_gone.clear();
    m_abandoned.clear();
    statisticSignals.start(cycle.get(), registry.get(), clock.isLockstep());
    journal.watchOverruns(&cycle->cycleStatistics());
    journal.clearAll(QStringLiteral("over, a real-time phase has begun"));
    apply(Event::CyclesStarted);
    for (const auto &node : LocalNodes(m_localNodes)) {
        node->start(m_profile.value);
        if (!m_isRunning)
            break;  // who heard of it has ended the phase
    }
    if (!m_isRunning) {
        answerRequester(true, {});
        return;
    }
    Q_EMIT q->realTimeHasStarted();
    answerRequester(true, {});
    // Whoever attached while the others were being started joins now.
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage == Connection::Attached)
            join(connection.get());
    }
}

/// Signals that are to be safe when the master stops safely: what nodes write, or have written in this phase, what is taken over, and whatever else has a value for
/// it in the table. Not what the master writes itself.
std::vector<bool> QPlcMasterNodePrivate::safeSignals(const qplc::Roster &roster)
{
    m_written.resize(std::size_t(table.size()));
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        for (const qplc::PayloadLayout::Field &field : slot->outputLayout.fields())
            m_written[field.signal] = true;
    }
    std::vector<bool> safe = m_written;
    for (QPlcSignalIndex signal = 0; signal < safe.size(); ++signal) {
        if (registry->writer(signal) == qplc::NodeRegistry::masterName())
            safe[signal] = false;
        else if (table.at(signal).safe.isValid() || (signal < roster.held.size() && roster.held[signal]))
            safe[signal] = true;
    }
    return safe;
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
    roster.safe = safeSignals(roster);
    for (const QPlcSignalIndex signal : m_abandoned) {
        if (registry->writer(signal).isEmpty())
            roster.abandoned.push_back(signal);
    }
    cycle->setRoster(roster);
}

// ---- stop ----

void QPlcMasterNodePrivate::stop(const QString &reason)
{
    apply(Event::Stop, state == QPlcMasterNode::Initializing ? QStringLiteral("stopped: %1").arg(reason) : reason);
}

void QPlcMasterNodePrivate::end(const QString &reason)
{
    apply(Event::End, reason);
}

void QPlcMasterNodePrivate::endCycles()
{
    if (!m_isRunning)
        return;
    m_isRunning = false;
    cycle->stop();
    statisticSignals.stop();
    journal.watchOverruns(nullptr);
    m_hasEnded = true;
}

void QPlcMasterNodePrivate::tellStopped(const QString &reason)
{
    if (!std::exchange(m_hasEnded, false))
        return;
    for (const std::unique_ptr<Connection> &connection : server->connections()) {
        if (connection->stage <= Connection::Attached)
            continue;
        connection->send(qplc::messages::RealTimeStopped{reason});
        connection->stage = Connection::Attached;
    }
    cycle->setRoster({});
    for (const auto &node : LocalNodes(m_localNodes))
        node->stop();
    takeReports();
    refusedValues.end();
    Q_EMIT q->realTimeHasStopped();
}

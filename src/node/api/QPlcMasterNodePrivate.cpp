// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterNodePrivate.h"

#include "LocalNode.h"
#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"
#include "node/session/RemoteNode.h"
#include "node/state/StateText.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"
#include "signals/MemoryNeed.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QThread>

#include <algorithm>
#include <numeric>
#include <utility>

using Action = qplc::MasterAction;
using Event = qplc::MasterEvent;
using qplc::JournalEvent;
using qplc::NodeRegistry;
using qplc::NodeSlot;

namespace {

quint64 newSession()
{
    return qplc::Host::current().random() | 1;  // never 0
}

qplc::messages::MasterHello helloOf(const QPlcMasterNodePrivate &master)
{
    qplc::messages::MasterHello message;
    message.protocol = qplc::messages::protocolVersion;
    message.name = NodeRegistry::masterName();
    message.uuid = master.uuid;
    message.session = master.session;
    message.tableHash = master.table.hash();
    message.state = qplc::messageStateOf(master.state());
    message.period = master.phaseSettings.interval;
    message.security = master.networkSecurity;
    message.faults = master.serverSettings.faultPlan;
    return message;
}

/// What the profile of a phase would depend on now.
qplc::ProfileFacts factsOf(const QPlcMasterNodePrivate &master)
{
    qplc::ProfileFacts facts;
    facts.wanted = master.phaseSettings.profile;
    facts.hasManifest = !master.needed.manifest().isEmpty();
    facts.ofManifest = master.needed.manifest().profile;
    facts.clock = master.phaseSettings.clock;
    if (!master.parts)
        return facts;
    const qplc::MasterServer &server = master.parts->server;
    if (server.port() != 0 && !server.address().isLoopback())
        facts.networkAddress = server.address().toString();
    const auto &nodes = master.parts->registry.nodes();
    const auto found = std::find_if(nodes.begin(), nodes.end(),
                                    [](const std::shared_ptr<NodeSlot> &slot) { return slot->hardware; });
    if (found != nodes.end())
        facts.hardwareNode = (*found)->name;
    return facts;
}

/// What a recording tells of a master: nothing secret.
QMap<QString, QString> parametersOf(const QPlcMasterNodePrivate &master)
{
    QMap<QString, QString> parameters{{QStringLiteral("program"), QCoreApplication::applicationName()},
                                      {QStringLiteral("program_version"), QCoreApplication::applicationVersion()},
                                      {QStringLiteral("qt_version"), QString::fromLatin1(qVersion())},
                                      {QStringLiteral("security"), master.networkSecurity},
                                      {QStringLiteral("profile_reason"), master.profile().reason}};
    if (!master.serverSettings.faultPlan.isEmpty())
        parameters.insert(QStringLiteral("fault_plan"), master.serverSettings.faultPlan);
    return parameters;
}

/// Name of a node of this process with real devices; empty: there is none.
QString localDevice(const NodeRegistry &registry)
{
    const auto &nodes = registry.nodes();
    const auto found = std::find_if(nodes.begin(), nodes.end(), [](const std::shared_ptr<NodeSlot> &slot) {
        return slot->local && slot->hardware;
    });
    return found != nodes.end() ? (*found)->name : QString();
}

/// Of the values of all signals: in the process image, and in a copy of it for those who ask.
quint64 bytesOfValues(const QPlcSignalTable &table)
{
    return std::accumulate(table.begin(), table.end(), quint64(0), [](quint64 sum, const QPlcSignalDefinition &signal) {
        return sum + 2 * quint64(signal.type.size());
    });
}

/// Why the present state refuses \a event.
/// \param text  of the table of states: %1: the reason of the state, %2: what stands in the way
QString refusalText(const QPlcMasterNodePrivate &master, Event event, const char *text)
{
    QString sentence = QString::fromLatin1(text);
    sentence.replace(QStringLiteral("%1"), master.stateReason);
    sentence.replace(QStringLiteral("%2"),
                     event == Event::ResetTooEarly ? master.parts->faults.remainingCause() : master.missingText());
    return QStringLiteral("%1 is not possible in state %2: %3")
        .arg(QLatin1String(qplc::requestName(event)), qplc::stateText(QLatin1String(qplc::nameOf(master.state()))),
             sentence);
}

/// Of a node that has set no watchdog, in the next phase; 0: watchdogs only report.
std::chrono::nanoseconds usualWatchdog(const QPlcMasterNodePrivate &master)
{
    const qplc::ProfileDefaults &defaults = qplc::ProfileDefaults::of(master.profile().value);
    if (defaults.reaction == QPlcSlaveNode::WatchdogReaction::Report)
        return {};
    return std::max<std::chrono::nanoseconds>(defaults.watchdog,
                                              defaults.watchdogPeriods * master.phaseSettings.interval);
}

/// Where the events of a plant go that has people or machines to answer for. A simulator has no
/// disk.
std::optional<qplc::EventFile::Place> usualEventFile(const QPlcMasterNodePrivate &master)
{
    const bool isInUse = master.parts && (master.parts->server.port() != 0 || master.parts->isPhaseUnderWay());
    const bool isStrict = !master.serverSettings.security.isNone() || master.profile().value == QPlcProfile::Plant;
    if (!isInUse || !isStrict || !qplc::Host::current().hasKernelTimers())
        return std::nullopt;
    const qplc::ServerSettings &settings = master.serverSettings;
    QString name = settings.localName.isEmpty() ? QCoreApplication::applicationName() : settings.localName;
    if (settings.localName.isEmpty() && settings.port != 0)
        name += QStringLiteral("-%1").arg(settings.port);
    return qplc::EventFile::usualPlace(name.isEmpty() ? NodeRegistry::masterName() : name);
}

/// A program that turns the clock may have no application of Qt. Timers and sockets need one, and a
/// dispatcher of events in this thread, which a loop makes.
void makeApplication(std::optional<qplc::OwnApplication> *application)
{
    if (*application)
        return;
    application->emplace();
    const QEventLoop loop;
}

}  // namespace

QPlcMasterNodePrivate::QPlcMasterNodePrivate(QPlcMasterNode *master)
    : q(master)
    , error(journal, [this](QPlcMasterNode::Error value) { Q_EMIT q->errorOccurred(value); })
    , phaseProfile(journal, [this] { return factsOf(*this); })
    , session(newSession())
    , uuid(qplc::newUuid())
    , needed(nodes, [this] { return usualWatchdog(*this); })
    , eventKeeper(journal,
                  {session, [this] { return usualEventFile(*this); },
                   [this] {
                       return parts && parts->phase.isRunning() ? std::make_optional(parts->phase.cycle())
                                                                : std::nullopt;
                   }})
{
}

QPlcMasterNodePrivate::Parts::Parts(QPlcMasterNodePrivate &master)
    : registry(master.table)
    , cycle(master.table, master.hub, lcCyclic().isDebugEnabled())
    , settings(registry, cycle, master.leaseBooks)
    , leases(master.leaseBooks, registry, cycle, settings)
    , ownSignals(registry, master.table, master.leaseBooks, settings)
    , rosters(master.table, registry, master.nodes, master.leaseBooks)
    , phase(cycle, registry, rosters, ownSignals, master.phaseSettings, master.phaseProfile, master.journal)
    , server(
          registry, cycle.image(), master.hub, master.session, [&master] { return helloOf(master); },
          [this, &master](qplc::NodeDeclaration *node, const Connection &from, const QString &transport) {
              const qplc::Refusal refusal = master.needed.judge(node, transport, from.peer.provenIdentity());
              return refusal.error.isEmpty() && isPhaseUnderWay() ? master.phaseProfile.objectionTo(*node) : refusal;
          },
          master.evictions, nullptr)
    , faults(master, master.error, master.nodes, phase)
    , reports(master, cycle, registry, master.nodes, phase, faults, master.phaseSettings, master.journal)
    , audit(server, master.journal, phase)
    , evictions(master.evictions, server, master.nodes, master.needed, master.journal, phase)
    , viewers(server, master.journal, settings, leases, phase, master.table)
    , texts(server, master.journal, settings, leases, phase, cycle, registry)
    , values(cycle, registry, master.leaseBooks, ownSignals.statistics())
    , starts(master.phaseSettings, master.phaseProfile, phase, master.hub, master.session)
    , step(master.stepTimer)
    , joining(step, master.joinTimer, master.nodes, values, starts, phase, master.phaseProfile, master.journal)
    , initialization(master, step, master.nodes, values, master.phaseProfile, joining)
    , starting(master, step, master.nodes, starts, master.phaseProfile, phase, joining)
    , stopping(master, step, master.nodes)
{
}

/// What the parts tell the master, and the program.
void QPlcMasterNodePrivate::connectParts()
{
    using qplc::MasterServer;
    const MasterServer &server = parts->server;
    QObject::connect(&server, &MasterServer::attached, q, [this](Connection *newcomer) { nodeAttached(newcomer); });
    QObject::connect(&server, &MasterServer::lost, q,
                     [this](Connection *gone, const QString &reason) { nodeLost(gone, reason); });
    QObject::connect(&server, &MasterServer::received, q,
                     [this](Connection *sender, const QPlcMessage &message) { receive(sender, message); });
    QObject::connect(&server, &MasterServer::refused, q,
                     [this](const QString &name, const QString &, const QString &reason) {
                         needed.tellFate(name, QStringLiteral("was refused: %1").arg(reason));
                         Q_EMIT q->nodeRefused(name, reason);
                     });
    QObject::connect(&parts->leases, &qplc::MasterLeases::changed, q, &QPlcMasterNode::leaseChanged);
    QObject::connect(&parts->reports, &qplc::MasterReports::realTimeViolated, q, &QPlcMasterNode::realTimeViolated);
    const qplc::InitializeSequence &initialization = parts->initialization;
    QObject::connect(&initialization, &qplc::InitializeSequence::statesInitialized, q,
                     &QPlcMasterNode::statesInitialized);
    QObject::connect(&initialization, &qplc::InitializeSequence::done, q, [this] {
        if (m_startAfterwards) {
            startInitialized();
            return;
        }
        apply(Event::StatesInitialized);
        asker.done();
    });
    const qplc::StartSequence &starting = parts->starting;
    QObject::connect(&starting, &qplc::StartSequence::realTimeHasStarted, q, &QPlcMasterNode::realTimeHasStarted);
    QObject::connect(&starting, &qplc::StartSequence::done, q, [this] { asker.done(); });
}

// ---- set-up ----

bool QPlcMasterNodePrivate::prepare()
{
    if (phaseSettings.clock.isExternal())
        makeApplication(&application);
    if (parts)
        return true;
    if (table.isEmpty())
        table = QPlcSignalIndexTable::current();
    if (table.isEmpty())
        return error.set(
            QPlcMasterNode::SignalError,
            QStringLiteral(
                "the master has no signals; read a table with QPlcSignalIndexTable::initializeFromIniFile() %1")
                .arg(QPlcSignalIndexTable::lastErrorString())
                .trimmed());
    const qplc::MemoryNeed need("the values of the signals", bytesOfValues(table), "use a table with fewer signals");
    parts = std::make_unique<Parts>(*this);
    connectParts();
    return true;
}

bool QPlcMasterNodePrivate::startServer(const QPlcUnderlyingProtocol &protocol)
{
    if (!prepare() || !apply(Event::Listen))
        return false;
    const QPlcSecurity &security = serverSettings.security;
    const QString fault = security.isNone() ? needed.identityFault() : security.errorString(QPlcSecurity::MasterSide);
    if (!fault.isEmpty()) {
        error.set(QPlcMasterNode::ServerError, fault);
        apply(Event::ServerFailed, error.text());
        return false;
    }
    serverSettings.port = protocol.port();
    const QHostAddress address = serverSettings.allowedAddress(protocol.address());
    networkSecurity = serverSettings.securityName(address);
    qplc::MasterServer &server = parts->server;
    server.setSecurity(serverSettings.security);
    server.close();  // the frames of its nodes follow the last fault plan
    QString text;
    hub.setFaults(serverSettings.faultPlan.isEmpty() ? std::nullopt
                                                     : qplc::FaultPlan::fromText(serverSettings.faultPlan, &text));
    if (!serverSettings.faultPlan.isEmpty())
        journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                     QStringLiteral("the master injects faults on purpose: %1").arg(serverSettings.faultPlan));
    server.setMaximumConnections(serverSettings.maximumConnections);
    const QString &name = serverSettings.localName;
    if (!server.listen(address, protocol.port(), name, serverSettings.multicastGroup)) {
        apply(Event::ServerFailed, server.errorString());
        return error.set(QPlcMasterNode::ServerError, server.errorString());
    }
    apply(Event::ServerListens);
    beacon.begin(address,
                 {server.port(), !serverSettings.security.isNone(), table.hash(),
                  name.isEmpty() ? QCoreApplication::applicationName() : name},
                 serverSettings.hasBeacon);
    qCInfo(lcMaster).noquote() << "listening on" << address.toString() << "port" << server.port() << "security"
                               << serverSettings.security.modeName();
    eventKeeper.keep();
    return error.clear();
}

// ---- nodes ----

bool QPlcMasterNodePrivate::addLocalNode(QPlcSlaveNode *node)
{
    if (!prepare() || !apply(Event::AddNode, QStringLiteral("node '%1' is added").arg(node->name())))
        return false;
    if (QPlcSignalIndexTable::current().isEmpty())
        QPlcSignalIndexTable::setCurrent(table);  // what the node's lists of signals look their names up in
    QPlcSlaveNodePrivate &program = QPlcSlaveNodePrivate::of(*node);
    QString text;
    if (!qplc::LocalNode::bind(program, table, &text))
        return error.set(QPlcMasterNode::SignalError, text);
    qplc::Refusal refusal;
    qplc::NodeDeclaration declaration = qplc::LocalNode::declarationOf(program);
    refusal = needed.judge(&declaration, qplc::NodeSession::inProcess(), QString());
    const std::shared_ptr<NodeSlot> slot
        = refusal.error.isEmpty() ? parts->registry.admit(declaration, &refusal) : nullptr;
    if (!slot)
        return error.set(QPlcMasterNode::NodeError, refusal.text);
    slot->prepare(parts->cycle.image(), session);
    parts->settings.leaveToWriters();
    const auto local = std::make_shared<qplc::LocalNode>(program, slot);
    nodes.add(local);
    local->join(q);
    Q_EMIT q->nodeRegistered(slot->name);
    return error.clear();
}

void QPlcMasterNodePrivate::removeLocalNode(QPlcSlaveNode *node)
{
    if (!parts)
        return;
    apply(Event::End, QStringLiteral("node '%1' is removed").arg(node->name()));
    const std::shared_ptr<qplc::NodeSession> local = nodes.of(node);
    if (!local)
        return;
    nodes.remove(*local);
    parts->registry.remove(local->slot());
    needed.forget(node->name());
    needed.tellFate(node->name(), QStringLiteral("was removed"));
    journal.nodeTellsNoMore(node->name());
    local->leave();
}

void QPlcMasterNodePrivate::nodeAttached(Connection *connection)
{
    const QString name = connection->name;
    const auto node = std::make_shared<qplc::RemoteNode>(parts->server, *connection);
    connection->session = node;
    nodes.add(node);
    parts->settings.leaveToWriters();
    journal.tell(JournalEvent::Info, JournalEvent::Node, name,
                 QStringLiteral("node %1 registered over %2").arg(name, connection->cyclicKind));
    if (!connection->fallbackReason.isEmpty())
        journal.tell(JournalEvent::Warning, JournalEvent::Node, name,
                     QStringLiteral("node %1: %2").arg(name, connection->fallbackReason));
    if (!connection->slot->faultPlan.isEmpty())
        journal.tell(JournalEvent::Warning, JournalEvent::Node, name,
                     QStringLiteral("node %1 injects faults on purpose: %2").arg(name, connection->slot->faultPlan));
    Q_EMIT q->nodeRegistered(name);
    m_joiner = node;
    apply(node->isListener() ? Event::ListenerJoined : Event::NodeJoined,
          QStringLiteral("node %1 has joined").arg(node->name()));
    m_joiner.reset();
    if (node->stage() == qplc::NodeSession::Idle)
        journal.nodeReturned(name);
}

void QPlcMasterNodePrivate::nodeLost(Connection *connection, const QString &reason)
{
    const std::shared_ptr<qplc::NodeSession> node = connection->session;
    const std::shared_ptr<NodeSlot> slot = connection->slot;
    const qplc::NodeSession::Stage stage = node ? node->stage() : qplc::NodeSession::Idle;
    // While cycles run, what it wrote is missing from now on.
    const auto severity = parts->phase.isRunning() ? JournalEvent::Error : JournalEvent::Warning;
    if (stage != qplc::NodeSession::Idle && !slot->listener)
        journal.nodeLost(slot->name, severity, reason);
    else
        journal.tell(JournalEvent::Info, JournalEvent::Node, slot->name,
                     QStringLiteral("node %1 has left: %2").arg(slot->name, reason));
    journal.nodeTellsNoMore(slot->name);
    needed.tellFate(slot->name, QStringLiteral("has left: %1").arg(reason));
    const bool wasAwaited = node && parts->step.leave(*node);
    if (node) {
        nodes.remove(*node);
        node->leave();
    }
    parts->phase.nodeLeft(node.get(), *slot);
    Q_EMIT q->nodeLost(slot->name, reason);
    if (node)
        parts->faults.nodeLeft(*slot, stage, wasAwaited,
                               QStringLiteral("node '%1' has left: %2").arg(slot->name, reason));
}

void QPlcMasterNodePrivate::announce(const qplc::messages::StatesInitialized &news)
{
    for (const std::unique_ptr<Connection> &connection : parts->server.connections()) {
        if (connection->stage >= Connection::Greeted)
            connection->send(news);
    }
}

// ---- what people and programs ask for ----

bool QPlcMasterNodePrivate::initializeAllStates()
{
    return prepare() && error.clear()
        && apply(missingText().isEmpty() ? Event::Initialize : Event::InitializeIncomplete)
        && error.value() == QPlcMasterNode::NoError;
}

bool QPlcMasterNodePrivate::startRealTime(quint64 cycles, quint64 token)
{
    if (!prepare())
        return false;
    m_startThread = QThread::currentThreadId();
    const QString optionError = phaseSettings.realTimeOptions.errorString();
    if (!optionError.isEmpty())
        return error.set(QPlcMasterNode::RealTimeError, optionError);
    const QString device = phaseSettings.clock.isExternal() ? localDevice(parts->registry) : QString();
    if (!device.isEmpty())
        return error.set(QPlcMasterNode::NodeError,
                         QStringLiteral("node '%1' drives real devices in the process of the master, where nothing "
                                        "stops them if the program that turns the clock External hangs; run it as a "
                                        "program of its own, or set another clock")
                             .arg(device));
    error.clear();
    const QString plant
        = serverSettings.localName.isEmpty() ? QCoreApplication::applicationName() : serverSettings.localName;
    parts->phase.ring().setPlant(plant.isEmpty() ? QStringLiteral("master") : plant, session);
    parts->phase.ring().setParameters(parametersOf(*this));
    parts->phase.ring().setCallback([this](const QString &file) { Q_EMIT q->ringIsReady(file); });
    const quint64 cyclesOfThisPhase = std::exchange(phaseSettings.cyclesWanted, cycles);
    const bool isArmed = arming.permitsStart(token, qplc::monotonicNow(), serverSettings.isArmingRequired());
    if (apply(!isArmed ? Event::StartUnarmed : missingText().isEmpty() ? Event::Start : Event::StartIncomplete))
        return error.value() == QPlcMasterNode::NoError;
    phaseSettings.cyclesWanted = cyclesOfThisPhase;
    return false;
}

QPlcMasterNode::StepResult QPlcMasterNodePrivate::step()
{
    using Step = qplc::MasterCycle::Step;
    if (!parts)
        return QPlcMasterNode::StepResult::Stopped;
    const Step result = parts->cycle.step();
    if (QThread::currentThreadId() == m_startThread && parts->reports.hasNews()
        && !qplc::Host::current().runningStrand())
        parts->reports.take();
    switch (result) {
    case Step::Complete:
        return QPlcMasterNode::StepResult::Complete;
    case Step::Late:
        return QPlcMasterNode::StepResult::Late;
    case Step::Safe:
        return QPlcMasterNode::StepResult::SafeStop;
    case Step::Busy:
        return QPlcMasterNode::StepResult::Busy;
    case Step::Stopped:
        break;
    }
    return QPlcMasterNode::StepResult::Stopped;
}

bool QPlcMasterNodePrivate::arm()
{
    return prepare() && apply(Event::Arm) && error.clear();
}

bool QPlcMasterNodePrivate::reset()
{
    const bool isTooEarly = parts && !parts->faults.remainingCause().isEmpty();
    return apply(isTooEarly ? Event::ResetTooEarly : Event::Reset, QStringLiteral("reset")) && error.clear();
}

void QPlcMasterNodePrivate::stop(const QString &reason)
{
    apply(Event::Stop, m_state == QPlcMasterNode::Initializing ? QStringLiteral("stopped: %1").arg(reason) : reason);
}

QString QPlcMasterNodePrivate::missingText() const
{
    return needed.missingText(m_state == QPlcMasterNode::Ready ? qplc::NodeSession::Initialized
                                                               : qplc::NodeSession::Idle);
}

qplc::ChosenProfile QPlcMasterNodePrivate::profile() const
{
    return parts && parts->isPhaseUnderWay() ? phaseProfile.fixed() : phaseProfile.choice();
}

// ---- states ----

bool QPlcMasterNodePrivate::apply(Event event, const QString &reason)
{
    const auto &cell = qplc::masterStates().at(m_state, event);
    if (cell.verdict == qplc::Verdict::Ignored)
        return true;
    if (cell.verdict == qplc::Verdict::Refused)
        return error.set(QPlcMasterNode::StateError, refusalText(*this, event, cell.text));
    const bool isBegin = m_state == QPlcMasterNode::Off && cell.next != m_state && parts;
    if (isBegin && parts->phase.waitNoLonger())
        return apply(event, reason);  // who heard of the end may have done something
    prepareFor(cell.action);
    enter(cell.next, reason);
    if (m_state == cell.next)  // else who heard of it has done something
        carryOut(cell.action, reason);
    return true;
}

void QPlcMasterNodePrivate::enter(QPlcMasterNode::State newState, const QString &reason)
{
    if (m_state == newState)
        return;
    using State = QPlcMasterNode::State;
    const bool isTransient = newState == State::WaitingForLateSlaves
        || (m_state == State::WaitingForLateSlaves && newState == State::RealTime);
    m_state = newState;
    const bool isLatched = qplc::isLatched(m_state);
    stateReason = isLatched ? reason : QString();
    latch += isLatched ? 1 : 0;
    if (m_state == State::RealTime && !isTransient)
        askedStop = {};
    arming.disarm();
    const QString words = qplc::stateText(QLatin1String(qplc::nameOf(m_state)));
    if (isLatched && parts)
        parts->phase.keepCycles(words.toLower());
    if (!isTransient || parts->reports.isWaitTold())
        journal.stateChanged(reason.isEmpty() ? words : QStringLiteral("%1: %2").arg(words, reason), isTransient);
    Q_EMIT q->stateChanged(newState);
}

/// A critical node that came during the initialization has no values yet: the others must not start
/// without it.
void QPlcMasterNodePrivate::startInitialized()
{
    const QString missing = needed.missingText(qplc::NodeSession::Initialized);
    if (missing.isEmpty())
        carryOut(Action::StartNodes, {});
    else
        apply(Event::SequenceFailed, missing);
}

/// What has to be done before the next state is there.
void QPlcMasterNodePrivate::prepareFor(Action action)
{
    if (action == Action::EndCycles || action == Action::Unlatch)
        parts->phase.end();
    else if (action == Action::MakeCyclesSafe || action == Action::LatchReason)
        parts->phase.makeSafe();
}

/// What is done in the state that has been reached.
void QPlcMasterNodePrivate::carryOut(Action action, const QString &reason)
{
    switch (action) {
    case Action::CollectOutputs:
    case Action::CollectThenStart:
        m_startAfterwards = action == Action::CollectThenStart;
        parts->initialization.begin();
        break;
    case Action::StartNodes:
        error.clear();
        parts->starting.begin();
        break;
    case Action::IssueToken:
        arming.arm(qplc::Host::current().random() | 1, qplc::monotonicNow());
        journal.tell(
            JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
            QStringLiteral("armed: one start is permitted within %1 s").arg(qplc::Arming::ValidFor / 1'000'000'000));
        break;
    case Action::EndSequence:
        parts->stopping.cancel(reason);
        error.set(QPlcMasterNode::InitializationError, reason);
        asker.fail(reason);
        break;
    case Action::EndCycles:
    case Action::Unlatch:
        if (!parts->phase.takeEnd())
            break;
        parts->stopping.stop(reason);
        for (const auto &node : nodes.all())
            journal.nodeReturned(node->name());
        parts->reports.takeLast();
        parts->texts.close();
        parts->phase.whenRecorded([this] { Q_EMIT q->realTimeHasStopped(); });
        break;
    case Action::MakeCyclesSafe:
    case Action::LatchReason:
        parts->stopping.makeSafe();
        Q_EMIT q->safelyStopped(stateReason);
        break;
    case Action::LetJoin:
        if (m_joiner)
            parts->joining.begin(*m_joiner);
        break;
    case Action::ForgetInitialization:
    case Action::None:
        break;
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "SimulatedPlant.h"

#include "Operator.h"
#include "QPlcManifest.h"
#include "protocol/ControlFrame.h"
#include "test_support/FrameWire.h"
#include "transport/ControlNetwork.h"

#include <QtCore/QTimer>

#include <algorithm>

using qplc::SimulatedHost;
using qplc::SimulatedRoad;

namespace soak {

namespace {

constexpr qint64 Second = 1'000'000'000;  // [ns]
constexpr quint16 MasterPort = 50000;

QHostAddress placeOf(int number)
{
    return QHostAddress(0x7F000101 + quint32(number));
}

/// A node that is no part of the plant.
class SoakJoiner : public QPlcCompactSlaveNode
{
public:
    explicit SoakJoiner(const QString &name)
        : QPlcCompactSlaveNode(name)
    {
    }
    ~SoakJoiner() override { disconnectFromMaster(); }

private:
    void step(const QPlcCycle &) override {}

    QPlcInput<quint32> m_counter{this, "n0.counter"};
};

/// Once in each period; after a stop it catches up, as a simulation does that a person has stopped.
void turnClock(SimulatedHost &host, QPlcMasterNode &master, std::int64_t period)
{
    std::int64_t next = host.now();
    while (!host.isMute()) {
        if (!host.sleepUntil(next))
            continue;
        const auto result = master.step();
        const bool isComputed
            = result == QPlcMasterNode::StepResult::Complete || result == QPlcMasterNode::StepResult::Late;
        next = (isComputed ? next : host.now()) + period;
    }
}

std::unique_ptr<SimulatedHost> newHost(qplc::Simulator &simulator, int node)
{
    const QString name = node < 0 ? QStringLiteral("Master") : nodeName(node);
    return std::make_unique<SimulatedHost>(simulator, name, placeOf(node + 1));
}

}  // namespace

// ---- histories ----

HistoryMemory::HistoryMemory(qplc::Simulator &simulator, const SimulatedHost *host, const QString &name, int node,
                             quint32 life)
    : m_simulator(simulator)
    , m_host(host)
{
    m_history.name = name;
    m_history.node = node;
    m_history.life = life;
}

void HistoryMemory::append(Record record) noexcept
{
    if (m_host && m_host->isMute())
        return;
    if (record.time == 0)
        record.time = m_simulator.now();
    m_history.records.push_back(record);
}

SimulatedPlant::SimulatedPlant(qplc::Simulator &simulator, const Profile &profile)
    : m_simulator(simulator)
    , m_profile(profile)
    , m_operatorHost(simulator, QStringLiteral("Operator"), placeOf(profile.shape.nodes + 1))
    , m_strangerHost(simulator, QStringLiteral("Stranger"), placeOf(profile.shape.nodes + 2))
    , m_runnerHistory(simulator, nullptr, QStringLiteral("Runner"), -1, 0)
{
    m_master.host = newHost(simulator, TheMaster);
    qplc::SeededRandom random(simulator.seed());
    for (int node = 0; node < profile.shape.nodes; ++node) {
        SimulatedHost::Clocks clocks;  // the master has the time of the histories
        clocks.offset = qint64(random.below(100)) * Second;
        clocks.drift = qint64(random.below(400'000)) - 200'000;
        m_nodes.push_back({newHost(simulator, node), 0});
        m_nodes.back().host->setClocks(clocks);
    }
}

SimulatedPlant::~SimulatedPlant() = default;

/// All nodes, and what each of them is.
QPlcManifest SimulatedPlant::manifest() const
{
    QPlcManifest manifest;
    for (int node = 0; node < m_profile.shape.nodes; ++node) {
        QPlcManifest::Node needed;
        needed.name = nodeName(node);
        needed.need = isCritical(node) ? QPlcManifest::Critical : QPlcManifest::Required;
        manifest.nodes.append(needed);
    }
    return manifest;
}

HistoryMemory &SimulatedPlant::newHistory(const Program &program, const QString &name, int node)
{
    const QString fullName = QStringLiteral("%1-life%2").arg(name).arg(program.life);
    m_histories.push_back(
        std::make_unique<HistoryMemory>(m_simulator, program.host.get(), fullName, node, program.life));
    return *m_histories.back();
}

Evidence SimulatedPlant::evidence() const
{
    Evidence evidence;
    evidence.shape = m_profile.shape;
    evidence.period = m_profile.periodUs * 1000;
    evidence.hasManifest = m_profile.hasManifest;
    evidence.runner = m_runnerHistory.history();
    for (const std::unique_ptr<HistoryMemory> &history : m_histories)
        (history->history().node < 0 ? evidence.masters : evidence.nodes).push_back(history->history());
    evidence.complete();
    return evidence;
}

// ---- programs ----

bool SimulatedPlant::prepare(QString *)
{
    return true;
}

QPlcUnderlyingProtocol SimulatedPlant::master() const
{
    return QPlcUnderlyingProtocol::tcp(m_master.host->address(), MasterPort);
}

/// Of programs that start now.
PlantShape SimulatedPlant::shape() const
{
    PlantShape shape = m_profile.shape;
    shape.edition = m_edition;
    return shape;
}

QPlcUnderlyingProtocol SimulatedPlant::cyclicPlace() const
{
    return QPlcUnderlyingProtocol::fromString(
        QStringLiteral("sim://%1:%2").arg(m_master.host->address().toString()).arg(MasterPort));
}

bool SimulatedPlant::startMaster(QString *error)
{
    bool listens = false;
    ++m_master.life;
    m_master.host->kill();
    HistoryMemory &history = newHistory(m_master, QStringLiteral("Master"), -1);
    m_master.host->start([&] {
        const NodeOptions options{shape(), 0, m_master.life};
        auto program = std::make_shared<SoakMaster>(options, history);
        m_masterProgram = program.get();
        history.append(Record::Born, Record::Nobody, {0, quint64(m_edition)});
        if (m_profile.hasManifest)
            program->setManifest(manifest());
        if (m_profile.isTurned) {
            program->setClock(QPlcClock::external());
            program->setLongestWait(std::chrono::microseconds(m_profile.periodUs / 2));
        }
        listens = program->start(std::chrono::microseconds(m_profile.periodUs), master());
        *error = program->errorString();
        return program;
    });
    if (m_profile.isTurned)
        m_master.host->startThread([&host = *m_master.host, &master = *m_masterProgram,
                                    period = m_profile.periodUs * 1000] { turnClock(host, master, period); });
    m_runnerHistory.append(Record::Started, -1, {0, m_master.life});
    return listens;
}

void SimulatedPlant::startNode(int node, const QString &linkFaults)
{
    Program &own = m_nodes[std::size_t(node)];
    if (own.host->isRunning()) {
        own.host->kill();
        m_runnerHistory.append(Record::Gone, node);
    }
    ++own.life;
    HistoryMemory &history = newHistory(own, nodeName(node), node);
    own.host->start([&] {
        const NodeOptions options{shape(), node, own.life};
        auto program = std::make_shared<SoakNode>(options, history);
        history.append(Record::Born, node, {0, quint64(m_edition)});
        program->activateWatchdog(std::chrono::microseconds(m_profile.shape.hold * m_profile.periodUs));
        program->setFaultPlan(linkFaults);
        program->setCritical(isCritical(node));
        program->setHardware(m_profile.isTurned);
        program->setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
        program->connectToMaster(cyclicPlace());
        return program;
    });
    m_runnerHistory.append(Record::Started, node, {0, own.life});
}

void SimulatedPlant::setStopped(int node, bool stopped)
{
    (node == TheMaster ? m_master : m_nodes[std::size_t(node)]).host->setStopped(stopped);
}

QStringList SimulatedPlant::end()
{
    for (const Program &node : m_nodes)
        node.host->kill();
    m_master.host->call([this] {
        m_masterProgram->stop();
        m_masterProgram->stopServer();
    });
    m_master.host->kill();
    return {};
}

// ---- faults ----

int SimulatedPlant::inject(const Fault &fault, Operator &person)
{
    switch (fault.kind) {
    case FaultKind::GarbageDatagrams:
    case FaultKind::GarbageToNodes:
        return sendDatagrams(fault, fault.kind == FaultKind::GarbageToNodes);
    case FaultKind::GarbageControl:
        return sendGarbage(fault);
    case FaultKind::StoppedReader:
        return askWithoutReading(fault);
    case FaultKind::SlowListener:
        return listenSlowly(fault);
    case FaultKind::ConnectFlood:
        return flood(fault);
    case FaultKind::MissingNode:
        return leaveOut(fault, person);
    case FaultKind::Siege:
        return besiege(fault, person);
    case FaultKind::OtherParameters:
        return changeParameters(fault, person);
    case FaultKind::SilentJoiner:
        return joinSilently(fault, person);
    case FaultKind::PowerNode:
    case FaultKind::PowerMaster:
        switchOff(fault);
        break;
    case FaultKind::CutRoad:
    case FaultKind::CutRoadToNode:
        cut(fault);
        break;
    case FaultKind::StepWallClock:
        stepClock(*m_nodes[std::size_t(fault.node)].host);
        break;
    case FaultKind::StepMasterClock:
        stepClock(*m_master.host);
        break;
    default:
        worsen(fault);
    }
    return fault.amount;
}

void SimulatedPlant::last(const Fault &fault, const std::function<void()> &undo)
{
    if (fault.pause < 0) {
        Operator::wait(fault.amount);
        undo();
        return;
    }
    m_lastCause = std::max(m_lastCause, Operator::now() + fault.amount);
    QTimer::singleShot(fault.amount, Qt::PreciseTimer, &m_causes, undo);
}

void SimulatedPlant::waitForCauses()
{
    Operator::wait(int(std::max<qint64>(0, m_lastCause - Operator::now())) + 1);
}

void SimulatedPlant::switchOff(const Fault &fault)
{
    const bool isOfMaster = fault.kind == FaultKind::PowerMaster;
    (isOfMaster ? m_master : m_nodes[std::size_t(fault.node)]).host->kill(SimulatedHost::End::Power);
    last(fault, [this, isOfMaster, node = fault.node] {
        QString error;
        if (isOfMaster)
            startMaster(&error);
        else
            startNode(node, {});
    });
}

void SimulatedPlant::cut(const Fault &fault)
{
    const SimulatedHost &node = *m_nodes[std::size_t(fault.node)].host;
    SimulatedRoad road = m_simulator.network().usual;
    road.isCut = true;
    m_simulator.network().setRoad(*m_master.host, node, road);
    if (fault.kind == FaultKind::CutRoad)
        m_simulator.network().setRoad(node, *m_master.host, road);
    last(fault, [this] { m_simulator.network().resetRoads(); });
}

/// Makes roads worse.
void SimulatedPlant::worsen(const Fault &fault)
{
    SimulatedRoad road;
    if (fault.kind == FaultKind::LoseOnRoads) {
        road.loss = 0.1;
        m_simulator.network().usual = road;
    } else if (fault.kind == FaultKind::DisorderOnRoads) {
        road.duplication = road.reordering = 0.3;
        road.lateness = 3 * m_profile.periodUs * 1000;
        m_simulator.network().usual = road;
    } else if (fault.kind == FaultKind::EchoOnRoads) {
        road.echo = 0.2;
        road.echoTime = 3 * Second;
        m_simulator.network().usual = road;
    } else {
        const SimulatedHost &node = *m_nodes[std::size_t(fault.node)].host;
        road.delay = 3 * m_profile.periodUs * 1000;
        m_simulator.network().setRoad(*m_master.host, node, road);
        m_simulator.network().setRoad(node, *m_master.host, road);
    }
    last(fault, [this] {
        m_simulator.network().usual = SimulatedRoad();
        m_simulator.network().resetRoads();
    });
}

void SimulatedPlant::stepClock(SimulatedHost &host)
{
    SimulatedHost::Clocks clocks = host.clocks();
    clocks.wallOffset -= 3600 * Second;
    host.setClocks(clocks);
    Operator::wait(100);
}

// ---- strangers ----

int SimulatedPlant::sendDatagrams(const Fault &fault, bool toNodes)
{
    StrangerWords words(fault.seed);
    qplc::FrameEnd end(m_strangerHost, m_simulator.frameWire().freePort(m_strangerHost));
    std::vector<quint64> places;
    for (const qplc::FrameEnd *place : m_simulator.frameWire().ends()) {
        if (place != &end && (&place->host() == m_master.host.get()) != toNodes)
            places.push_back(place->key());
    }
    int sent = 0;
    for (int i = 0; i < fault.amount && !places.empty(); ++i) {
        const QByteArray bytes = words.randomBytes(int(words.number() % 600));
        end.send(places[std::size_t(i) % places.size()], bytes.constData(), std::size_t(bytes.size()));
        ++sent;
        if (i % 10 == 9)
            Operator::wait(2);
    }
    return sent;
}

/// Begins connections to the master.
SimulatedPlant::Connections SimulatedPlant::connectFrom(SimulatedHost &host, int count)
{
    Connections connections;
    host.call([&] {
        for (int i = 0; i < count; ++i) {
            connections.emplace_back(qplc::ControlNetwork::current().makeSocket(nullptr));
            connections.back()->connectToHost(m_master.host->address(), MasterPort);
        }
    });
    return connections;
}

/// Connections of the stranger to the master, as many as can be made.
SimulatedPlant::Connections SimulatedPlant::connect(int count)
{
    Connections connections = connectFrom(m_strangerHost, count);
    Operator::wait(2);
    const auto isOpen
        = [](const std::unique_ptr<QTcpSocket> &socket) { return socket->state() == QAbstractSocket::ConnectedState; };
    connections.erase(std::stable_partition(connections.begin(), connections.end(), isOpen), connections.end());
    return connections;
}

int SimulatedPlant::sendGarbage(const Fault &fault)
{
    StrangerWords words(fault.seed);
    const Connections connections = connect(fault.amount);
    m_strangerHost.call([&] {
        for (const std::unique_ptr<QTcpSocket> &socket : connections)
            socket->write(words.garbageMessage());
    });
    Operator::wait(50);
    return int(connections.size());
}

int SimulatedPlant::askWithoutReading(const Fault &fault)
{
    const Connections connections = connect(1);
    m_strangerHost.call([&] {
        for (const std::unique_ptr<QTcpSocket> &socket : connections) {
            socket->write(qplc::encodeControlFrame(StrangerWords::greeting()));
            for (int i = 0; i < fault.amount; ++i)
                socket->write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::GetSignals)));
        }
    });
    Operator::wait(200);
    return connections.empty() ? 0 : fault.amount;
}

int SimulatedPlant::listenSlowly(const Fault &fault)
{
    constexpr int look = 10;  // [ms]
    const Connections connections = connect(1);
    const auto send = [&](const QPlcMessage &message) {
        m_strangerHost.call([&] { connections.front()->write(qplc::encodeControlFrame(message)); });
    };
    qint64 received = 0;
    if (!connections.empty())
        send(StrangerWords::greeting());
    for (int time = 0; time < fault.amount && !connections.empty(); time += look) {
        send(QPlcMessage(QPlcMessage::GetSignals));
        Operator::wait(look);
        m_strangerHost.call([&] { received += connections.front()->read(512).size(); });
    }
    return int(received);
}

int SimulatedPlant::flood(const Fault &fault)
{
    const Connections connections = connect(fault.amount);
    Operator::wait(100);
    return int(connections.size());
}

/// Strangers of several addresses: each opens 1000 connections a second that stay and send nothing,
/// and sends 3000 datagrams.
int SimulatedPlant::besiege(const Fault &fault, Operator &person)
{
    constexpr int strangers = 4;
    constexpr int look = 10;  // [ms]
    StrangerWords words(fault.seed);
    Hosts hosts;
    std::vector<Connections> connections;
    for (int i = 0; i < strangers; ++i)
        hosts.push_back(std::make_unique<SimulatedHost>(m_simulator, QStringLiteral("Besieger%1").arg(i),
                                                        placeOf(m_profile.shape.nodes + 3 + i)));
    person.expectAnother(fault.node);
    for (int time = 0; time < fault.amount; time += look) {
        for (const auto &host : hosts) {
            connections.push_back(connectFrom(*host, 10));
            qplc::FrameEnd end(*host, m_simulator.frameWire().freePort(*host));
            for (const qplc::FrameEnd *place : m_simulator.frameWire().ends()) {
                if (&place->host() != m_master.host.get())
                    continue;
                for (int i = 0; i < 30; ++i) {
                    const QByteArray bytes = words.randomBytes(int(words.number() % 100));
                    end.send(place->key(), bytes.constData(), std::size_t(bytes.size()));
                }
            }
        }
        if (time == 10 * look)
            startNode(fault.node, {});
        Operator::wait(look);
    }
    return fault.amount;
}

/// Nodes with a table of their own are kept out, until somebody gives them the new one. Were they
/// not, the operator would start the plant.
int SimulatedPlant::changeParameters(const Fault &fault, Operator &person)
{
    QString error;
    m_master.host->kill();
    Operator::wait(int((m_profile.shape.hold + 2) * m_profile.periodUs / 1000));
    ++m_edition;
    startMaster(&error);
    person.useMaster(master());
    (void)person.bringToRealTime(fault.amount);
    for (int node = 0; node < m_profile.shape.nodes; ++node) {
        if (hasOwnTable(node))
            startNode(node, {});
    }
    return fault.amount;
}

/// A node registers while cycles run, or while none do, and its program stands still from then on.
/// \return 0: the plant does not run while it does
int SimulatedPlant::joinSilently(const Fault &fault, Operator &person)
{
    constexpr int longest = 10'000;  // [ms]
    const QString name = QStringLiteral("Joiner");
    SimulatedHost host(m_simulator, name, placeOf(m_profile.shape.nodes + 7));
    if (fault.seed % 2 == 0)
        person.stop();
    host.start([&] {
        auto program = std::make_shared<SoakJoiner>(name);
        QObject::connect(program.get(), &QPlcSlaveNode::connectedToMaster, program.get(),
                         [&host] { host.setStopped(true); });
        program->connectToMaster(cyclicPlace());
        return program;
    });
    const qint64 end = Operator::now() + longest;
    while (!person.sees(name) && Operator::now() < end)
        Operator::wait(1);
    while (person.sees(name) && Operator::now() < end) {
        person.tryToStart();
        Operator::wait(10);
    }
    return Operator::now() < end && person.bringToRealTime(longest) ? fault.amount : 0;
}

int SimulatedPlant::leaveOut(const Fault &fault, Operator &person)
{
    person.expectAnother(fault.node);
    m_nodes[std::size_t(fault.node)].host->kill();
    m_runnerHistory.append(Record::Gone, fault.node);
    Operator::wait(fault.amount / 2);
    person.tryToStartWithout(fault.node);
    startNode(fault.node, {});
    return fault.amount;
}

}  // namespace soak

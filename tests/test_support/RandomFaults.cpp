// SPDX-License-Identifier: Apache-2.0
#include "RandomFaults.h"

#include "test_support/SimulatedHost.h"
#include "test_support/SimulatedTransport.h"

#include <QtPlcCore>

#include <array>

using namespace qplc;

namespace {

constexpr std::int64_t Second = 1'000'000'000;  // [ns]
constexpr int NodeCount = 3;
constexpr std::array<const char *, NodeCount> Names{"a", "b", "c"};
constexpr std::array<const char *, 11> Texts{"node killed",
                                             "node without power",
                                             "node stopped",
                                             "road cut",
                                             "road to the node cut",
                                             "a third of the frames lost",
                                             "frames doubled and late",
                                             "wall clock stepped back",
                                             "master stopped",
                                             "master killed",
                                             "master without power"};

QPlcSignalTable ringTable()
{
    QVector<QPlcParseError> errors;
    return QPlcSignalTable::fromIni("[a]\ntype = Real64\n[b]\ntype = Real64\n[c]\ntype = Real64\n", &errors);
}

QHostAddress placeOf(int number)
{
    return QHostAddress(0x7F000101 + quint32(number));
}

/// Reads the signal of the node before it.
class RingNode final : public QPlcCompactSlaveNode
{
public:
    explicit RingNode(int number)
        : QPlcCompactSlaveNode(QStringLiteral("Node%1").arg(number))
        , m_input(this, Names[std::size_t((number + NodeCount - 1) % NodeCount)])
        , m_output(this, Names[std::size_t(number)])
    {
        setSignalTable(ringTable());
    }
    ~RingNode() override { disconnectFromMaster(); }

private:
    void reset() override { m_output = 0.0; }
    void step(const QPlcCycle &) override { m_output = m_input + 1.0; }

    QPlcInput<double> m_input;
    QPlcOutput<double> m_output;
};

/// A master and its nodes, each on a host of its own with clocks of its own.
class RingPlant
{
public:
    RingPlant(Simulator &simulator, std::uint64_t seed)
        : m_simulator(simulator)
        , m_masterHost(simulator, QStringLiteral("master"), placeOf(0))
    {
        SeededRandom random(seed);
        startMaster();
        for (int number = 0; number < NodeCount; ++number) {
            m_hosts.push_back(
                std::make_unique<SimulatedHost>(simulator, QStringLiteral("node%1").arg(number), placeOf(number + 1)));
            SimulatedHost::Clocks clocks;
            clocks.offset = std::int64_t(random.below(100)) * Second;
            clocks.drift = std::int64_t(random.below(400'000)) - 200'000;
            m_hosts.back()->setClocks(clocks);
            startNode(number);
        }
    }
    void happen(const PlannedFault &fault);
    bool comesBack();
    QString missedCycles();
    QString text() const
    {
        return QStringLiteral("%1 nodes, state %2, %3 %4")
            .arg(m_master->nodes().size())
            .arg(int(m_master->state()))
            .arg(m_master->errorString(), m_master->causeThatRemains());
    }
    void end()
    {
        m_masterHost.call([this] { m_master->stop(); });
    }

private:
    void startMaster();
    void startNode(int number);
    void cut(int number, bool isOneWay, std::int64_t duration);
    bool isRunning() const
    {
        return m_master->state() == QPlcMasterNode::RealTime && m_master->nodes().size() == NodeCount;
    }
    void tryToStart();

    Simulator &m_simulator;
    SimulatedHost m_masterHost;
    std::vector<std::unique_ptr<SimulatedHost>> m_hosts;
    QPlcMasterNode *m_master = nullptr;
    std::array<RingNode *, NodeCount> m_nodes{};
};

void RingPlant::startMaster()
{
    m_masterHost.start([this] {
        auto master = std::make_shared<QPlcMasterNode>();
        m_master = master.get();
        master->setSignalTable(ringTable());
        master->setInterval(std::chrono::milliseconds(10));
        master->setProfile(QPlcProfile::Plant);
        master->startServer(QPlcUnderlyingProtocol::tcp(placeOf(0), 50000));
        return master;
    });
}

void RingPlant::startNode(int number)
{
    m_hosts[std::size_t(number)]->start([this, number] {
        auto node = std::make_shared<RingNode>(number);
        m_nodes[std::size_t(number)] = node.get();
        node->setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
        node->connectToMaster(QPlcUnderlyingProtocol::fromString(QStringLiteral("sim://127.0.1.1:50000")));
        return node;
    });
}

void RingPlant::cut(int number, bool isOneWay, std::int64_t duration)
{
    SimulatedRoad road;
    road.isCut = true;
    SimulatedHost &host = *m_hosts[std::size_t(number)];
    m_simulator.network().setRoad(m_masterHost, host, road);
    if (!isOneWay)
        m_simulator.network().setRoad(host, m_masterHost, road);
    m_simulator.runFor(duration);
    m_simulator.network().resetRoads();
}

void RingPlant::happen(const PlannedFault &fault)
{
    using Fault = PlannedFault;
    m_simulator.runFor(fault.pause);
    const bool isOfMaster = fault.kind >= Fault::MasterStopped;
    SimulatedHost &host = isOfMaster ? m_masterHost : *m_hosts[std::size_t(fault.node)];
    switch (fault.kind) {
    case Fault::NodeKilled:
    case Fault::NodePowerLost:
    case Fault::MasterKilled:
    case Fault::MasterPowerLost:
        host.kill(fault.kind == Fault::NodeKilled || fault.kind == Fault::MasterKilled ? SimulatedHost::End::Program
                                                                                       : SimulatedHost::End::Power);
        m_simulator.runFor(fault.duration);
        isOfMaster ? startMaster() : startNode(fault.node);
        break;
    case Fault::NodeStopped:
    case Fault::MasterStopped:
        host.setStopped(true);
        m_simulator.runFor(fault.duration);
        host.setStopped(false);
        break;
    case Fault::RoadCut:
    case Fault::RoadCutOneWay:
        cut(fault.node, fault.kind == Fault::RoadCutOneWay, 4 * fault.duration);
        break;
    case Fault::FramesLost:
        m_simulator.network().usual.loss = 0.3;
        m_simulator.runFor(fault.duration);
        break;
    case Fault::FramesDisordered:
        m_simulator.network().usual.duplication = 0.5;
        m_simulator.network().usual.jitter = 30'000'000;
        m_simulator.runFor(fault.duration);
        break;
    case Fault::WallClockStepped: {
        SimulatedHost::Clocks clocks = host.clocks();
        clocks.wallOffset -= 3600 * Second;
        host.setClocks(clocks);
        break;
    }
    }
    m_simulator.network().usual = SimulatedRoad();
}

/// One try of a person.
void RingPlant::tryToStart()
{
    m_masterHost.call([this] {
        if (m_master->state() == QPlcMasterNode::SafeStop || m_master->state() == QPlcMasterNode::Fault)
            m_master->reset();
    });
    m_simulator.runFor(Second);
    m_masterHost.call([this] { m_master->initializeAllStates(); });
    m_simulator.runUntil([this] { return m_master->state() == QPlcMasterNode::Ready; }, 3 * Second);
    m_masterHost.call([this] { m_master->startRealTime(); });
    m_simulator.runUntil([this] { return isRunning(); }, Second);
}

bool RingPlant::comesBack()
{
    const std::int64_t end = m_simulator.now() + 60 * Second;
    while (!isRunning() && m_simulator.now() < end) {
        if (m_master->nodes().size() == NodeCount && m_master->state() != QPlcMasterNode::RealTime)
            tryToStart();
        else
            m_simulator.runFor(Second / 10);
    }
    return isRunning();
}

QString RingPlant::missedCycles()
{
    std::array<quint64, NodeCount> before{};
    for (std::size_t number = 0; number < NodeCount; ++number)
        before[number] = m_nodes[number]->counters().cycles;
    m_simulator.runFor(Second);
    for (std::size_t number = 0; number < NodeCount; ++number) {
        const quint64 cycles = m_nodes[number]->counters().cycles - before[number];
        if (cycles < 98 || cycles > 102)
            return QStringLiteral("node %1 has %2 cycles in a second, not 100").arg(number).arg(cycles);
    }
    return {};
}

}  // namespace

QString PlannedFault::toString() const
{
    const QString what = QString::fromLatin1(Texts[std::size_t(kind)]);
    const QString who
        = kind < FramesLost || kind == WallClockStepped ? QStringLiteral(" (node %1)").arg(node) : QString();
    return QStringLiteral("after %1 s: %2%3 for %4 s")
        .arg(double(pause) * 1e-9, 0, 'f', 3)
        .arg(what, who)
        .arg(double(duration) * 1e-9, 0, 'f', 3);
}

FaultPlanOfPlant planFor(std::uint64_t seed, int seconds)
{
    SeededRandom random(seed * 2 + 1);
    FaultPlanOfPlant plan;
    for (std::int64_t left = seconds * Second; left > 0; left -= plan.back().pause + plan.back().duration) {
        PlannedFault fault;
        fault.kind = PlannedFault::Kind(random.below(Texts.size()));
        fault.node = int(random.below(NodeCount));
        fault.pause = std::int64_t(random.below(std::uint64_t(4 * Second)));
        fault.duration = std::int64_t(random.below(std::uint64_t(3 * Second)));
        plan.push_back(fault);
    }
    return plan;
}

PlantVerdict runPlan(std::uint64_t seed, const FaultPlanOfPlant &plan)
{
    SimulatedTransport::install();
    PlantVerdict verdict;
    Simulator::run(seed, [&](Simulator &simulator) {
        RingPlant plant(simulator, seed);
        bool isBack = plant.comesBack();
        for (const PlannedFault &fault : plan) {
            if (!isBack)
                break;
            plant.happen(fault);
            isBack = fault.kind < PlannedFault::MasterStopped || plant.comesBack();
        }
        isBack = isBack && plant.comesBack();
        simulator.runFor(10 * Second);  // what was late has come
        isBack = isBack && plant.comesBack();
        verdict.violation
            = isBack ? plant.missedCycles() : QStringLiteral("the plant does not come back: ") + plant.text();
        verdict.digest = simulator.digest();
        plant.end();
    });
    return verdict;
}

FaultPlanOfPlant shrunk(FaultPlanOfPlant plan, const std::function<bool(const FaultPlanOfPlant &)> &fails)
{
    for (std::size_t place = plan.size(); place-- > 0;) {
        FaultPlanOfPlant shorter = plan;
        shorter.erase(shorter.begin() + std::ptrdiff_t(place));
        if (fails(shorter))
            plan = shorter;
    }
    return plan;
}

// SPDX-License-Identifier: Apache-2.0
// usage: simulated_plant [NODES [SECONDS [SEED]]]: a master and nodes at 100 Hz in virtual time
#include "test_support/SimulatedHost.h"
#include "test_support/SimulatedTransport.h"

#include <QtPlcCore>

#include <chrono>
#include <cstdio>
#include <cstdlib>

using namespace qplc;

namespace {

constexpr std::int64_t Second = 1'000'000'000;  // [ns]

QByteArray nameOf(int node)
{
    return "signal" + QByteArray::number(node);
}

QPlcSignalTable tableOf(int nodes)
{
    QByteArray text;
    for (int node = 0; node < nodes; ++node)
        text += "[" + nameOf(node) + "]\ntype = Real64\n";
    QVector<QPlcParseError> errors;
    return QPlcSignalTable::fromIni(text, &errors);
}

/// Reads the signal of the node before it.
class RingNode : public QPlcCompactSlaveNode
{
public:
    RingNode(int number, int nodes)
        : QPlcCompactSlaveNode(QStringLiteral("Node%1").arg(number))
        , m_input(this, nameOf((number + nodes - 1) % nodes).constData())
        , m_output(this, nameOf(number).constData())
    {
        setSignalTable(tableOf(nodes));
    }
    ~RingNode() override { disconnectFromMaster(); }

private:
    void reset() override { m_output = 0.0; }
    void step(const QPlcCycle &) override { m_output = m_input + 1.0; }

    QPlcInput<double> m_input;
    QPlcOutput<double> m_output;
};

QHostAddress addressOf(int host)
{
    return QHostAddress(0x7F000101 + quint32(host));
}

double secondsSince(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// \return whether cycles ran
bool fly(Simulator &simulator, int nodes, std::int64_t duration)
{
    SimulatedHost masterHost(simulator, QStringLiteral("master"), addressOf(0));
    QPlcMasterNode *master = nullptr;
    masterHost.start([&] {
        auto made = std::make_shared<QPlcMasterNode>();
        master = made.get();
        master->setSignalTable(tableOf(nodes));
        master->setInterval(std::chrono::milliseconds(10));
        master->startServer(QPlcUnderlyingProtocol::tcp(addressOf(0), 50000));
        return made;
    });
    std::vector<std::unique_ptr<SimulatedHost>> hosts;
    for (int number = 0; number < nodes; ++number) {
        hosts.push_back(
            std::make_unique<SimulatedHost>(simulator, QStringLiteral("node%1").arg(number), addressOf(number + 1)));
        hosts.back()->start([&] {
            auto node = std::make_shared<RingNode>(number, nodes);
            node->connectToMaster(QPlcUnderlyingProtocol::fromString(QStringLiteral("sim://127.0.1.1:50000")));
            return node;
        });
    }
    const auto reaches = [&](QPlcMasterNode::State state) {
        return simulator.runUntil([&] { return master->state() == state; }, 10 * Second);
    };
    if (!simulator.runUntil([&] { return master->nodes().size() == nodes; }, 10 * Second))
        return false;
    masterHost.call([&] { master->initializeAllStates(); });
    if (!reaches(QPlcMasterNode::Ready))
        return false;
    masterHost.call([&] { master->startRealTime(); });
    if (!reaches(QPlcMasterNode::RealTime))
        return false;
    const auto begin = std::chrono::steady_clock::now();
    simulator.runFor(duration);
    const double taken = secondsSince(begin);
    const QPlcMasterStatistics statistics = master->statistics();
    std::printf("{\"nodes\": %d, \"cycles\": %llu, \"seconds\": %.3f, \"times_real_time\": %.1f, \"events\": %llu, "
                "\"digest\": \"%016llx\"}\n",
                nodes, qulonglong(statistics.cycles), taken, double(duration) / Second / taken,
                qulonglong(simulator.eventCount()), qulonglong(simulator.digest()));
    masterHost.call([&] { master->stop(); });
    return statistics.cycles > 0;
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    SimulatedTransport::install();
    const int nodes = argc > 1 ? std::atoi(argv[1]) : 12;
    const std::int64_t duration = (argc > 2 ? std::atoi(argv[2]) : 60) * Second;
    bool hasFlown = false;
    Simulator::run(argc > 3 ? std::strtoull(argv[3], nullptr, 0) : 1,
                   [&](Simulator &simulator) { hasFlown = fly(simulator, nodes, duration); });
    return hasFlown ? 0 : 1;
}

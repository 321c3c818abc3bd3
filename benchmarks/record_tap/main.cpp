// SPDX-License-Identifier: Apache-2.0
// record_tap: what a cycle costs more because it writes a record into a ring. Cycles with and
// without a ring take turns, so that the same machine judges both. Prints a line for each size:
// cycles of a master without nodes, and with a node over UDP.
#include "QPlcCompactSlaveNode.h"
#include "QPlcOutput.h"
#include "node/api/QPlcMasterNodePrivate.h"
#include "node/cycle/MasterCycle.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QElapsedTimer>
#include <QtCore/QEventLoop>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

namespace {

using qplc::MasterCycle;
using qplc::RecordRing;

constexpr int Rounds = 200;
constexpr int CyclesOfARound = 250;

QByteArray ini(int signalCount)
{
    QByteArray text;
    for (int i = 0; i < signalCount; ++i)
        text += "[s" + QByteArray::number(i) + "]\ntype = Real64\n";
    return text;
}

/// A master whose image has so many bytes.
struct Master
{
    Master(int signalCount, bool hasRing)
        : table(QPlcSignalTable::fromIni(ini(signalCount)))
        , cycle(table, hub, false)
    {
        MasterCycle::Phase phase;
        phase.period = std::chrono::milliseconds(1);
        phase.clock = QPlcClock::external();
        if (hasRing) {
            phase.ring = std::make_shared<RecordRing>();
            const std::size_t size = qplc::CycleTap::usualSize(cycle.image(), 0);
            QString error;
            if (!phase.ring->create({}, RecordRing::capacityFor(1000.0, 60.0, size, qplc::RingMemory::folder()), {},
                                    &error))
                qFatal("%s", qPrintable(error));
        }
        cycle.start(phase);
    }
    ~Master() { cycle.stop(); }

    void run(std::vector<std::int64_t> *times)
    {
        for (int i = 0; i < CyclesOfARound; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            cycle.step();
            times->push_back((std::chrono::steady_clock::now() - begin).count());
        }
    }

    QPlcSignalTable table;
    qplc::CyclicHub hub;
    MasterCycle cycle;
};

class Node : public QPlcCompactSlaveNode
{
public:
    Node()
        : QPlcCompactSlaveNode(QStringLiteral("Node"))
    {
        for (int i = 0; i < 32; ++i)
            m_outputs.push_back(std::make_unique<QPlcOutput<double>>(this, qPrintable(QStringLiteral("s%1").arg(i))));
    }

private:
    void step(const QPlcCycle &cycle) override
    {
        for (const auto &output : m_outputs)
            *output = double(cycle.number());
    }
    std::vector<std::unique_ptr<QPlcOutput<double>>> m_outputs;
};

/// A master with a node over UDP, whose cycle has its own thread.
struct Plant
{
    Plant(int signalCount, bool hasRing)
    {
        master.setSignalTable(QPlcSignalTable::fromIni(ini(signalCount)));
        master.setClock(QPlcClock::external());
        master.setProfile(QPlcProfile::Simulation);
        master.setInterval(std::chrono::milliseconds(1));
        QPlcMasterNodePrivate::of(master).phaseSettings.hasRing = hasRing;
        const auto address = [](quint16 port) { return QPlcUnderlyingProtocol::udp(QHostAddress::LocalHost, port); };
        if (!master.startServer(address(0)) || !node.connectToMasterAndWaitForConnected(address(master.serverPort()))
            || !master.startRealTime())
            qFatal("%s%s", qPrintable(master.errorString()), qPrintable(node.errorString()));
        QElapsedTimer patience;
        patience.start();
        while (master.state() != QPlcMasterNode::RealTime && patience.elapsed() < 10'000)
            QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
        size = QPlcMasterNodePrivate::of(master).parts->cycle.image().totalSize();
    }
    void run(std::vector<std::int64_t> *times)
    {
        for (int i = 0; i < CyclesOfARound; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            const bool isComplete = master.step() == QPlcMasterNode::StepResult::Complete;
            if (isComplete)
                times->push_back((std::chrono::steady_clock::now() - begin).count());
        }
        QCoreApplication::processEvents();
    }

    QPlcMasterNode master;
    Node node;
    std::uint32_t size = 0;
};

std::int64_t percentile(std::vector<std::int64_t> *times, double q)
{
    const auto at = times->begin() + std::ptrdiff_t(q * double(times->size() - 1));
    std::nth_element(times->begin(), at, times->end());
    return *at;
}

template<typename Runner>
void compare(const char *what, Runner &with, Runner &without, std::uint32_t size)
{
    std::vector<std::int64_t> withTimes;
    std::vector<std::int64_t> withoutTimes;
    for (int round = 0; round < Rounds; ++round) {
        without.run(&withoutTimes);
        with.run(&withTimes);
    }
    if (withTimes.empty() || withoutTimes.empty())
        qFatal("no cycle was complete");
    const std::int64_t added = percentile(&withTimes, 0.5) - percentile(&withoutTimes, 0.5);
    const double ratio = double(percentile(&withTimes, 0.99)) / double(percentile(&withoutTimes, 0.99));
    std::printf("%u bytes, %s: p50 %lld ns without a ring, %lld ns with one, added %lld ns; p99 ratio %.2f\n", size,
                what, static_cast<long long>(percentile(&withoutTimes, 0.5)),
                static_cast<long long>(percentile(&withTimes, 0.5)), static_cast<long long>(added), ratio);
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    for (const int signalCount : {24, 190, 4440}) {
        Master with(signalCount, true);
        Master without(signalCount, false);
        compare("no nodes", with, without, with.cycle.image().totalSize());
    }
    Plant with(190, true);
    Plant without(190, false);
    compare("a node over UDP", with, without, with.size);
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
// record_tap: what a cycle costs more because it writes a record into a ring. Cycles with and
// without a ring take turns, so that the same machine judges both. Prints a line for each size.
#include "node/cycle/MasterCycle.h"

#include <QtCore/QCoreApplication>

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

    static QByteArray ini(int signalCount)
    {
        QByteArray text;
        for (int i = 0; i < signalCount; ++i)
            text += "[s" + QByteArray::number(i) + "]\ntype = Real64\n";
        return text;
    }
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

std::int64_t percentile(std::vector<std::int64_t> *times, double q)
{
    const auto at = times->begin() + std::ptrdiff_t(q * double(times->size() - 1));
    std::nth_element(times->begin(), at, times->end());
    return *at;
}

void compare(int signalCount)
{
    Master with(signalCount, true);
    Master without(signalCount, false);
    std::vector<std::int64_t> withTimes;
    std::vector<std::int64_t> withoutTimes;
    for (int round = 0; round < Rounds; ++round) {
        without.run(&withoutTimes);
        with.run(&withTimes);
    }
    const std::int64_t added = percentile(&withTimes, 0.5) - percentile(&withoutTimes, 0.5);
    const double ratio = double(percentile(&withTimes, 0.99)) / double(percentile(&withoutTimes, 0.99));
    std::printf("%u bytes: p50 %lld ns without a ring, %lld ns with one, added %lld ns; p99 ratio %.2f\n",
                with.cycle.image().totalSize(), static_cast<long long>(percentile(&withoutTimes, 0.5)),
                static_cast<long long>(percentile(&withTimes, 0.5)), static_cast<long long>(added), ratio);
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    for (const int signalCount : {24, 190, 4440})
        compare(signalCount);
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
// usage: simulink_step [ROUNDS]: the step of an exported model, called alone and as a node in turn
#include "awe_lawe_model.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

extern "C" {
#include "LaweModel.h"
}

namespace {

constexpr int stepsOfRound = 2000;

template<typename Step>
double nanosecondsOf(Step step)
{
    const auto begin = std::chrono::steady_clock::now();
    bool isComputed = true;
    for (int i = 0; i < stepsOfRound; ++i)
        isComputed &= step();
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    return isComputed ? spent.count() / stepsOfRound : std::numeric_limits<double>::max();
}

}  // namespace

int main(int argc, char **argv)
{
    const QString given = QString::fromLocal8Bit(argc > 1 ? argv[1] : "100");
    const int rounds = given.toInt();
    if (rounds < 1) {
        std::fprintf(stderr, "'%s' rounds are not possible; use a number from 1\n", qPrintable(given));
        return 2;
    }
    const std::unique_ptr<QPlcSimulinkNode> node = make_awe_lawe_model();
    node->activateWorkloadMeasurement(QString());  // which reads clocks
    QPlcNodeRunner runner(*node, node->sampleTime());
    if (!runner.bind(QPlcSignalTable::fromIni(node->table().toUtf8()))) {
        std::fprintf(stderr, "%s\n", qPrintable(runner.errorString()));
        return 1;
    }
    double alone = std::numeric_limits<double>::max();
    double asNode = alone;
    for (int round = 0; round < rounds; ++round) {
        // The same flight twice; the fastest round of each counts.
        LaweModel_initialize();
        alone = std::min(alone, nanosecondsOf([] {
                             LaweModel_step();
                             return true;
                         }));
        if (!runner.reset() || !runner.initialize())
            return 1;
        asNode = std::min(asNode, nanosecondsOf([&runner] { return runner.step(); }));
        if (runner.hasFailed() || LaweModel_M->Timing.clockTick0 != stepsOfRound) {
            std::fprintf(stderr, "the node has not computed: %s\n", qPrintable(runner.errorString()));
            return 1;
        }
    }
    std::printf("{\"function_ns\": %.1f, \"node_ns\": %.1f, \"difference_ns\": %.1f}\n", alone, asNode, asNode - alone);
    return 0;
}

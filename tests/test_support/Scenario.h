// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SoakReport.h"

namespace soak {

/// What may happen to a simulated plant.
struct Scenario
{
    Profile profile;  // with the name of the scenario
    QString description;
    double crowding = 0;  // share of the faults behind which the next one does not wait [0 ... 1]

    static const std::vector<Scenario> &all();
    static const Scenario *named(const QString &name);
};

/// What happens within about \a seconds because of \a seed.
std::vector<Fault> planOf(const Scenario &scenario, int seconds, quint64 seed);

/// What came out of a simulated run.
struct SimulatedRun
{
    SoakReport report;
    quint64 digest = 0;  // of all that has travelled on the network

    /// The first gate that failed, with an example, or why the run ended early. Empty: all gates
    /// hold.
    QString violation() const;
};
SimulatedRun run(const Scenario &scenario, int seconds, quint64 seed, const std::vector<Fault> &plan);

/// The shortest plan that still fails of those that leave faults of \a plan out one after the
/// other.
std::vector<Fault> shrunk(std::vector<Fault> plan, const std::function<bool(const std::vector<Fault> &)> &fails);

}  // namespace soak

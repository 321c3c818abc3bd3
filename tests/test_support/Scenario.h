// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SoakReport.h"

#include <functional>
#include <optional>

namespace soak {

/// What may happen to a simulated plant.
struct Scenario
{
    Profile profile;  // with the name of the scenario
    QString description;
    double crowding = 0;  // share of the faults behind which the next one does not wait [0 ... 1]

    static const std::vector<Scenario> &all();
    static const Scenario *named(const QString &name);
    static QStringList names();
};

/// Reads a whole number from \a least to the largest int. \return nothing if \a text is none;
/// \a error says what to use
std::optional<quint64> wholeNumber(const QString &text, quint64 least, QString *error);

/// All that decides what happens in a simulated run.
struct SimulatedPlan
{
    const Scenario *scenario = nullptr;
    quint64 seed = 0;  // of the network and the hosts
    int seconds = 0;   // no fault begins later
    std::vector<Fault> faults;

    /// A line for the scenario, the seed, the time and each fault.
    QString toText() const;
    /// Reads what toText() writes. Empty lines and those that begin with '#' say nothing.
    /// \return nothing when \a text is no plan: \a error begins with the number of the line
    static std::optional<SimulatedPlan> fromText(const QString &text, QString *error);
};

/// What happens within about \a seconds because of \a seed.
SimulatedPlan planOf(const Scenario &scenario, int seconds, quint64 seed);

/// What came out of a simulated run.
struct SimulatedRun
{
    SoakReport report;
    quint64 digest = 0;  // of all that has travelled on the network

    /// The first gate that failed, with an example, or why the run ended early. Empty: all gates
    /// hold.
    QString violation() const;
    /// The name of that gate.
    QString violatedGate() const { return violation().section(QLatin1Char(':'), 0, 0); }
};
SimulatedRun run(const SimulatedPlan &plan);

/// A plan that still fails, of which no fault can be left out, and no time shortened to its half.
/// \param plan  fails
SimulatedPlan shrunk(SimulatedPlan plan, const std::function<bool(const SimulatedPlan &)> &fails);
/// As above: it violates the same gate as \a plan.
SimulatedPlan shrunk(const SimulatedPlan &plan);

}  // namespace soak

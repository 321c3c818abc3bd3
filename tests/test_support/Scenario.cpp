// SPDX-License-Identifier: Apache-2.0
#include "Scenario.h"

#include "SimulatedPlant.h"
#include "SoakRun.h"
#include "test_support/SimulatedTransport.h"

#include <algorithm>
#include <limits>

namespace soak {

namespace {

using Weights = std::vector<std::pair<FaultKind, int>>;

Scenario scenario(const char *name, const char *description, const Weights &weights, double crowding = 0)
{
    Scenario made;
    made.profile.name = QString::fromLatin1(name);
    made.description = QString::fromLatin1(description);
    made.profile.shape = {12, 12, 3};
    made.profile.faultEvery = 500;
    made.profile.hasProcesses = false;
    for (const auto &[kind, weight] : weights)
        made.profile.weights[std::size_t(kind)] = weight;
    made.crowding = crowding;
    return made;
}

/// Those of the soak with processes.
Weights soakWeights()
{
    const Profile soak = *Profile::named(QStringLiteral("short"));
    Weights weights;
    for (std::size_t kind = 0; kind < soak.weights.size(); ++kind)
        weights.emplace_back(FaultKind(kind), soak.weights[kind]);
    return weights;
}

/// Whether its amount is a time.
bool lasts(FaultKind kind)
{
    return kind == FaultKind::StopNode || kind == FaultKind::StopMaster
        || (kind >= FaultKind::PowerNode && kind != FaultKind::Siege && kind != FaultKind::SilentJoiner);
}

/// Whether its cause may end while the next fault happens.
bool mayOverlap(FaultKind kind)
{
    return kind >= FaultKind::PowerNode && kind != FaultKind::SlowListener && kind < FaultKind::EvictNode;
}

}  // namespace

const std::vector<Scenario> &Scenario::all()
{
    using F = FaultKind;
    static const Weights programs{{F::KillNode, 3}, {F::KillMaster, 1}, {F::PowerNode, 3},     {F::PowerMaster, 1},
                                  {F::StopNode, 2}, {F::StopMaster, 1}, {F::StepWallClock, 1}, {F::StepMasterClock, 1}};
    static const Weights roads{{F::CutRoad, 3},       {F::CutRoadToNode, 3},   {F::DelayOnRoad, 2},
                               {F::LoseOnRoads, 2},   {F::DisorderOnRoads, 2}, {F::PowerNode, 1},
                               {F::LoseFrames, 1},    {F::DuplicateFrames, 1}, {F::ReorderFrames, 1},
                               {F::CorruptFrames, 1}, {F::CutLink, 1}};
    static const Weights tools{{F::StoppedReader, 2},  {F::SlowListener, 2},     {F::ConnectFlood, 1},
                               {F::GarbageControl, 1}, {F::GarbageDatagrams, 1}, {F::GarbageToNodes, 1},
                               {F::KillNode, 1}};
    static const Weights restarts{{F::KillMaster, 3}, {F::PowerMaster, 2}, {F::KillNode, 2},       {F::PowerNode, 1},
                                  {F::StopMaster, 1}, {F::EchoOnRoads, 4}, {F::OtherParameters, 3}};
    static const Weights admissions{
        {F::EvictNode, 5},    {F::MissingNode, 4},    {F::Siege, 2},           {F::SilentJoiner, 3}, {F::KillNode, 2},
        {F::PowerNode, 2},    {F::KillMaster, 1},     {F::PowerMaster, 1},     {F::StopMaster, 1},   {F::CutRoad, 1},
        {F::ConnectFlood, 2}, {F::GarbageControl, 2}, {F::GarbageDatagrams, 2}};
    static const auto everything = [] {
        Weights weights = soakWeights();
        for (const Weights *more : {&programs, &roads, &tools})
            weights.insert(weights.end(), more->begin(), more->end());
        return weights;
    }();
    static const std::vector<Scenario> scenarios{
        scenario("soak", "what qtplc_soak does to processes", soakWeights()),
        scenario("programs", "kills, restarts, power failures, stopped programs, clocks that step", programs),
        scenario("roads", "cuts, half-open connections, delays, losses, duplicates, disorder", roads),
        scenario("tools", "readers that are slow or stop, strangers, floods", tools),
        scenario("restarts",
                 "masters, also with other safety parameters, and nodes come back amid frames of former lives",
                 restarts),
        [] {
            Scenario made = scenario(
                "admissions", "a plant with a manifest: evictions, strangers, starts without a node, silent nodes",
                admissions, 0.5);
            made.profile.hasManifest = true;
            return made;
        }(),
        [] {
            Weights weights = programs;
            weights.insert(weights.end(), roads.begin(), roads.end());
            Scenario made = scenario("turned", "those of programs and roads, while a program turns the clock", weights);
            made.profile.isTurned = true;
            return made;
        }(),
        scenario("all", "those of soak, programs, roads and tools, one after the other", everything),
        scenario(
            "storm", "all of programs and roads, while the plant has not recovered from the last",
            [] {
                Weights weights = programs;
                weights.insert(weights.end(), roads.begin(), roads.end());
                return weights;
            }(),
            0.7),
    };
    return scenarios;
}

const Scenario *Scenario::named(const QString &name)
{
    const auto isIt = [&](const Scenario &scenario) { return scenario.profile.name == name; };
    const auto found = std::find_if(all().begin(), all().end(), isIt);
    return found == all().end() ? nullptr : &*found;
}

QStringList Scenario::names()
{
    QStringList names;
    for (const Scenario &scenario : all())
        names << scenario.profile.name;
    return names;
}

std::optional<quint64> wholeNumber(const QString &text, quint64 least, QString *error)
{
    constexpr int most = std::numeric_limits<int>::max();
    bool isNumber = false;
    const quint64 value = text.toULongLong(&isNumber);
    if (isNumber && value >= least && value <= quint64(most))
        return value;
    *error = QStringLiteral("use a whole number from %1 to %2").arg(least).arg(most);
    return std::nullopt;
}

SimulatedPlan planOf(const Scenario &scenario, int seconds, quint64 seed)
{
    SimulatedPlan plan{&scenario, seed, seconds,
                       planOf(scenario.profile, seconds * 1000 / scenario.profile.faultEvery, seed)};
    qplc::SeededRandom random(seed);
    for (Fault &fault : plan.faults) {
        if (lasts(fault.kind))
            fault.amount = int(double(fault.amount) * (0.3 + 1.7 * random.fraction()));
        if (mayOverlap(fault.kind) && random.fraction() < scenario.crowding)
            fault.pause = int(random.below(600));
    }
    return plan;
}

QString SimulatedRun::violation() const
{
    if (!report.error.isEmpty())
        return report.error;
    for (const Gate &gate : report.gates) {
        if (gate.failed > 0)
            return QStringLiteral("%1: %2").arg(gate.name, gate.examples.constFirst());
    }
    return report.gates.front().looked > 0 ? QString() : QStringLiteral("no cycle was judged");
}

SimulatedRun run(const SimulatedPlan &plan)
{
    qplc::SimulatedTransport::install();
    const Profile &profile = plan.scenario->profile;
    SimulatedRun result;
    SoakReport &report = result.report;
    report.profile = profile.name;
    report.seed = plan.seed;
    report.seconds = plan.seconds;
    qplc::Simulator::run(plan.seed, [&](qplc::Simulator &simulator) {
        SimulatedPlant plant(simulator, profile);
        plant.operatorHost().call([&] {
            SoakRun soakRun(profile, plan.seconds, plan.faults, plant, plant.runnerHistory());
            if (!soakRun.run())
                report.error = soakRun.errorString();
        });
        report.evidence = plant.evidence();
        result.digest = simulator.digest();
    });
    report.gates = judge(report.evidence, profile);
    return result;
}

}  // namespace soak

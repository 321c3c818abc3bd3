// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <cstdint>
#include <functional>
#include <vector>

/// One thing that happens to a simulated plant.
struct PlannedFault
{
    enum Kind : std::uint8_t {
        NodeKilled,
        NodePowerLost,
        NodeStopped,
        RoadCut,
        RoadCutOneWay,
        FramesLost,
        FramesDisordered,
        WallClockStepped,
        MasterStopped,
        MasterKilled,
        MasterPowerLost
    };
    Kind kind = NodeKilled;
    int node = 0;
    std::int64_t pause = 0;     // [ns] before it
    std::int64_t duration = 0;  // [ns]

    QString toString() const;
};

using FaultPlanOfPlant = std::vector<PlannedFault>;

/// What happens within about \a seconds because of \a seed.
FaultPlanOfPlant planFor(std::uint64_t seed, int seconds);

/// What a plant has to keep to.
struct PlantVerdict
{
    QString violation;  // empty: all gates hold
    std::uint64_t digest = 0;
};
/// Runs a master and three nodes with \a plan. The gates: as soon as the master is there again, the
/// nodes come back and the plant can be started within 60 s; at the end each node has as many
/// cycles as there were periods.
PlantVerdict runPlan(std::uint64_t seed, const FaultPlanOfPlant &plan);

/// The shortest plan that still fails of those that leave faults of \a plan out one after the
/// other.
FaultPlanOfPlant shrunk(FaultPlanOfPlant plan, const std::function<bool(const FaultPlanOfPlant &)> &fails);

// SPDX-License-Identifier: Apache-2.0
#include "OptionSignals.h"

#include <algorithm>

namespace awe {

namespace {

using Signals = std::vector<OptionSignal>;

void add(Signals *all, const char *name, double PlantDetails::*number)
{
    all->push_back({name, [number](const KiteDetails &kite) { return kite.plant.*number; }, {}});
}

/// Electrical / mechanical power while the winch generates, the inverse while it works.
double winchEfficiency(const KiteDetails &kite)
{
    const double mechanical = kite.outputs.power, electrical = kite.plant.electricalPower;
    if (mechanical * electrical <= 0.0)
        return 0.0;
    // While the drum slows down, its inertia gives more.
    return std::min(1.0, mechanical > 0.0 ? electrical / mechanical : mechanical / electrical);
}

void addAir(const AirParameters &air, Signals *all)
{
    if (air.profile != WindProfile::Uniform)
        all->push_back({"windVelocity6m_earth", {}, [](const KiteDetails &kite) { return kite.plant.windAt6m; }});
    if (air.isThinner)
        add(all, "airDensity", &PlantDetails::airDensity);
}

void addTether(const TetherParameters &tether, Signals *all)
{
    if (tether.kind == TetherKind::Spring)
        return;
    all->push_back({"winchTension", [](const KiteDetails &kite) { return kite.outputs.groundTension; }, {}});
    all->push_back({"wingTension", [](const KiteDetails &kite) { return kite.outputs.tetherForce.norm(); }, {}});
    const int nodes = tether.kind == TetherKind::Segments ? tether.segments - 1 : 0;
    for (int node = 0; node < nodes; ++node) {
        all->push_back({"tetherNode" + QByteArray::number(node + 1) + "_earth", {}, [node](const KiteDetails &kite) {
                            return kite.nodes[std::size_t(node)];
                        }});
    }
}

void addMachine(Signals *all)
{
    add(all, "drumSpeed", &PlantDetails::tetherSpeed);
    add(all, "machineSpeed", &PlantDetails::machineSpeed);
    add(all, "machineCurrent", &PlantDetails::machineCurrent);
    add(all, "machinePosition", &PlantDetails::machinePosition);
    add(all, "electricalPower", &PlantDetails::electricalPower);
    all->push_back({"electricalEnergy", [](const KiteDetails &kite) { return kite.plant.energies.electrical; }, {}});
    all->push_back({"winchEfficiency", winchEfficiency, {}});
}

}  // namespace

std::vector<OptionSignal> modelSignals(const PlantOptions &options)
{
    Signals all;
    addAir(options.air, &all);
    addTether(options.tether, &all);
    if (options.hasMachine)
        addMachine(&all);
    if (options.steering.kind == SteeringKind::TurnRate)
        add(&all, "steering", &PlantDetails::steering);
    if (options.hasTurbines) {
        add(&all, "turbinePower", &PlantDetails::turbinePower);
        add(&all, "turbineEnergy", &PlantDetails::turbineEnergy);
    }
    return all;
}

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#include "OptionSignals.h"

#include <algorithm>

namespace awe {

namespace {

using Signals = std::vector<OptionSignal>;

using Number = OptionSignal::Reader<double>;
using Vector = OptionSignal::Reader<Eigen::Vector3d>;

template<typename T>
void add(Signals *all, const char *name, T PlantDetails::*value)
{
    const OptionSignal::Reader<T> read = [value](const KiteDetails &kite) { return kite.plant.*value; };
    all->push_back({name, read});
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
        add(all, "windVelocity6m_earth", &PlantDetails::windAt6m);
    if (air.isThinner)
        add(all, "airDensity", &PlantDetails::airDensity);
}

void addTether(const TetherParameters &tether, Signals *all)
{
    if (tether.kind == TetherKind::Spring)
        return;
    all->push_back({"winchTension", Number([](const KiteDetails &kite) { return kite.outputs.groundTension; })});
    all->push_back({"wingTension", Number([](const KiteDetails &kite) { return kite.outputs.tetherForce.norm(); })});
    const int nodes = tether.kind == TetherKind::Segments ? tether.segments - 1 : 0;
    for (int node = 0; node < nodes; ++node) {
        all->push_back({"tetherNode" + QByteArray::number(node + 1) + "_earth",
                        Vector([node](const KiteDetails &kite) { return kite.nodes[std::size_t(node)]; })});
    }
}

void addMachine(Signals *all)
{
    add(all, "drumSpeed", &PlantDetails::tetherSpeed);
    add(all, "machineSpeed", &PlantDetails::machineSpeed);
    add(all, "machineCurrent", &PlantDetails::machineCurrent);
    add(all, "machinePosition", &PlantDetails::machinePosition);
    add(all, machineOffSignal, &PlantDetails::isMachineOff);
    add(all, "electricalPower", &PlantDetails::electricalPower);
    all->push_back(
        {"electricalEnergy", Number([](const KiteDetails &kite) { return kite.plant.energies.electrical; })});
    all->push_back({"winchEfficiency", Number(winchEfficiency)});
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
    if (options.mast.isPresent) {
        all.push_back({"mastTop_earth", Vector([top = options.mast.top()](const KiteDetails &) { return top; })});
        add(&all, mastDockedSignal, &PlantDetails::isDocked);
        add(&all, mastDockingsSignal, &PlantDetails::dockings);
        add(&all, mastDockingSpeedSignal, &PlantDetails::dockingSpeed);
    }
    return all;
}

QStringList optionSignalNames(const PlantOptions &options)
{
    QStringList names;
    for (const OptionSignal &signal : modelSignals(options))
        names << QString::fromLatin1(signal.name);
    const auto add = [&names](const char *name) { names << QString::fromLatin1(name); };
    if (options.steering.kind == SteeringKind::TurnRate)
        add(steeringCommandSignal);
    if (options.hasTurbines)
        add(turbineCoefficientSignal);
    if (options.mast.isPresent) {
        add(mastReleaseSignal);
        add(flightRequestSignal);
    }
    return names;
}

}  // namespace awe

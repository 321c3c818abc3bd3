// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSimulation.h"

#include <QtCore/QByteArray>
#include <QtCore/QStringList>

#include <functional>
#include <variant>
#include <vector>

namespace awe {

/// A signal of the model that belongs to an option of the plant.
struct OptionSignal
{
    template<typename T>
    using Reader = std::function<T(const KiteDetails &)>;

    QByteArray name;
    /// A number, a vector, whether something is so, or a count.
    std::variant<Reader<double>, Reader<Eigen::Vector3d>, Reader<bool>, Reader<qint32>> read;
};

/// Those of the model that the options ask for; none for the plant of the thesis.
std::vector<OptionSignal> modelSignals(const PlantOptions &options);

/// What the autopilot tells a wing that the air turns.
constexpr const char *steeringCommandSignal = "steeringCommand";
/// Whether overspeed has switched the machine of the winch off.
constexpr const char *machineOffSignal = "machineOff";
/// What the autopilot tells turbines on board.
constexpr const char *turbineCoefficientSignal = "turbineCoefficient";
/// What it tells a mast.
constexpr const char *mastReleaseSignal = "mastRelease";
/// Whether the wing hangs on the mast.
constexpr const char *mastDockedSignal = "mastDocked";
/// How often the wing came back to the mast, and how fast it was the last time [m/s].
constexpr const char *mastDockingsSignal = "mastDockings";
constexpr const char *mastDockingSpeedSignal = "mastDockingSpeed";
/// What an operator wants of a plant with a mast: a FlightRequest. No node writes it.
constexpr const char *flightRequestSignal = "flightRequest";

/// All signals that the options ask for: those of the model, and those between the operator, the
/// autopilot and the model.
QStringList optionSignalNames(const PlantOptions &options);

}  // namespace awe

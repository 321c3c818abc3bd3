// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSimulation.h"

#include <QtCore/QByteArray>

#include <functional>
#include <vector>

namespace awe {

/// A signal of the model that belongs to an option of the plant.
struct OptionSignal
{
    QByteArray name;
    // One of both:
    std::function<double(const KiteDetails &)> number;
    std::function<Eigen::Vector3d(const KiteDetails &)> vector;
};

/// Those of the model that the options ask for; none for the plant of the thesis.
std::vector<OptionSignal> modelSignals(const PlantOptions &options);

/// What the autopilot tells a wing that the air turns.
constexpr const char *steeringCommandSignal = "steeringCommand";
/// What it tells turbines on board.
constexpr const char *turbineCoefficientSignal = "turbineCoefficient";

}  // namespace awe

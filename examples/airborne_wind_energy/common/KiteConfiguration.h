// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantParameters.h"
#include "WindParameters.h"

#include <QtCore/QString>

#include <Eigen/Core>

#include <limits>

namespace awe {

/// Where the power comes from.
enum class FlightMode {
    Pumping,  ///< the winch generates in cycles of reeling out and in
    Drag      ///< turbines on board generate, and the tether keeps its length
};

/// Where the mean wind blows to, from x towards y [deg].
double downwindAzimuth(const WindParameters &wind);

/// The kite that the model computes, its tether, its wind and its start: section [kite] of the file
/// of --plant. The values here hold without a file.
struct KiteConfiguration
{
    static constexpr double derived = std::numeric_limits<double>::quiet_NaN();

    FlightMode mode = FlightMode::Pumping;
    PlantParameters plant;  // without its initial state, which is what follows
    WindParameters wind;
    int substeps = 1;               // Runge-Kutta steps in each cycle
    double elevation = 30.0;        // [deg]
    double azimuth = derived;       // [deg]; derived: downwind
    double distance = 100.0;        // from the ground station [m]
    double tetherLength = derived;  // [m]; derived: the distance, so the tether is taut and without load
    double pitchAngle = 9.0;        // [deg]
    double yawAngle = 0.0;          // [deg]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s], earth frame

    KiteConfiguration() { plant.groundContact = GroundContact::Hold; }

    /// Sets what \a key stands for to \a value. \return empty, or what is wrong and the remedy
    QString set(const QString &key, const QString &value);

    /// Sets the mode that \a word names: "pumping" or "drag".
    /// \return false when \a word is neither of them
    bool setMode(const QString &word);

    /// The plant with its initial state. \param wind  decides where downwind is
    PlantParameters plantIn(const WindParameters &wind) const;
};

}  // namespace awe

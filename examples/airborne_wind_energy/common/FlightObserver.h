// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightStatistics.h"
#include "PlantConfiguration.h"

#include <QtPlcCore>

#include <optional>

namespace awe {

/// Watches a flight from its signals: a node without outputs in the process of the master. Values
/// that are not good end the flight with a fault.
class FlightObserver : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    FlightObserver(const FlightStatisticsParameters &parameters, const PlantConfiguration &plant);

    /// \pre no cycle runs
    FlightReport report() const { return m_statistics.report(); }
    /// Whether a node has written where the kite is. \pre no cycle runs
    bool sawKite() const { return m_sawKite; }

private:
    using Vector = Eigen::Vector3d;

    void reset() override
    {
        m_statistics.reset();
        m_sawKite = false;
    }
    void step(const QPlcCycle &cycle) override;
    void requireGoodValues() const;

    FlightStatistics m_statistics;
    bool m_sawKite = false;

    QPlcInput<Vector> m_position{this, "bodyPosition_earth"};      // [m]
    QPlcInput<Vector> m_velocity{this, "bodyVelocity_earth"};      // [m/s]
    QPlcInput<Vector> m_windVelocity{this, "windVelocity_earth"};  // [m/s]
    QPlcInput<Vector> m_tetherForce{this, "tetherForce_earth"};    // [N]
    QPlcInput<double> m_tetherSpeed;                               // [m/s]
    QPlcInput<double> m_power{this, "power"};                      // [W]
    QPlcInput<double> m_energy{this, "energy"};                    // [J]
    QPlcInput<qint8> m_phase{this, "flightPhase"};
    // Of a machine at the winch:
    std::optional<QPlcInput<double>> m_electricalEnergy;  // [J]
    std::optional<QPlcInput<bool>> m_machineOff;
    std::optional<QPlcInput<double>> m_turbineEnergy;  // [J], of turbines on board
    // Of a mast:
    std::optional<QPlcInput<bool>> m_docked;
    std::optional<QPlcInput<bool>> m_crashed;  // also of a wing that hit the mast
    std::optional<QPlcInput<qint32>> m_dockings;
    std::optional<QPlcInput<double>> m_dockingSpeed;  // [m/s]
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Autopilot.h"

#include <QtPlcCore>

#include <optional>
#include <vector>

namespace awe {

/// The autopilot as a node.
class AutopilotNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// \param gains  with a turn-rate factor the node writes the steering, with a constant tether
    ///         the coefficient of the turbines, with a mast it releases the wing and reads what an
    ///         operator wants (FlightRequest)
    /// \param extraDeadTime cycles by which the commands are delayed on top of those that the links
    ///         cost
    explicit AutopilotNode(const AutopilotGains &gains, int extraDeadTime = 0);

private:
    using Vector = Eigen::Vector3d;

    void reset() override;
    void step(const QPlcCycle &cycle) override;
    FlightMeasurements measurements() const;
    void send(const AutopilotOutputs &commands);

    Autopilot m_autopilot;
    std::vector<AutopilotOutputs> m_delayed;  // ring of commands on their way
    std::size_t m_oldest = 0;

    QPlcInput<Vector> m_position{this, "bodyPosition_earth"};                // [m]
    QPlcInput<Vector> m_velocity{this, "bodyVelocity_earth"};                // [m/s]
    QPlcInput<Vector> m_windVelocity{this, "windVelocity_earth"};            // [m/s]
    QPlcInput<Vector> m_controlOrientation{this, "bodyControlOrientation"};  // [deg]
    QPlcInput<double> m_angleOfAttack{this, "angleOfAttack"};                // [deg]
    QPlcInput<Vector> m_tetherForce{this, "tetherForce_earth"};              // [N]
    QPlcInput<double> m_tetherLength{this, "tetherLength"};                  // [m]

    QPlcOutput<double> m_pitchSpeed{this, "bodyControlPitchSpeed"};  // [deg/s]
    QPlcOutput<double> m_yawSpeed{this, "bodyControlYawSpeed"};      // [deg/s]
    QPlcOutput<double> m_tetherSpeed{this, "tetherSpeed"};           // [m/s]
    QPlcOutput<qint8> m_phase{this, "flightPhase"};
    std::optional<QPlcOutput<double>> m_steering;            // [-], of a wing that the air turns
    std::optional<QPlcOutput<double>> m_turbineCoefficient;  // [-], of turbines on board
    // Of a mast:
    std::optional<QPlcInput<bool>> m_docked;
    std::optional<QPlcInput<FlightRequest>> m_request;
    std::optional<QPlcOutput<bool>> m_release;
};

}  // namespace awe

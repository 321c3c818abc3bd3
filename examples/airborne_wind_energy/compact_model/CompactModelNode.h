// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSimulation.h"
#include "OptionSignals.h"
#include "PlantConfiguration.h"

#include <QtPlcCore>

#include <functional>
#include <optional>
#include <vector>

namespace awe {

/// The plant as a node, written with ports: a cycle allocates nothing.
class CompactModelNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit CompactModelNode(const KiteSimulation &simulation, WinchKind winch = WinchKind::Ideal);

private:
    using Vector = Eigen::Vector3d;

    void reset() override { collect(m_simulation.reset()); }
    void step(const QPlcCycle &) override { collect(m_simulation.step(commands())); }
    void outputs() override { collect(m_simulation.outputs()); }
    void update(const QPlcCycle &) override { m_simulation.update(commands()); }
    PlantInputs commands() const;
    void addOptions();
    void collect(const PlantOutputs &outputs);

    KiteSimulation m_simulation;

    QPlcInput<double> m_pitchSpeed{this, "bodyControlPitchSpeed"};  // [deg/s]
    QPlcInput<double> m_yawSpeed{this, "bodyControlYawSpeed"};      // [deg/s]
    QPlcInput<double> m_tetherSpeed;                                // [m/s], > 0 reels out

    QPlcOutput<Vector> m_position{this, "bodyPosition_earth"};                  // [m]
    QPlcOutput<Vector> m_velocity{this, "bodyVelocity_earth"};                  // [m/s]
    QPlcOutput<Vector> m_windVelocity{this, "windVelocity_earth"};              // [m/s]
    QPlcOutput<Vector> m_controlOrientation{this, "bodyControlOrientation"};    // [deg]
    QPlcOutput<Vector> m_positionOrientation{this, "bodyPositionOrientation"};  // [deg]
    QPlcOutput<double> m_angleOfAttack{this, "angleOfAttack"};                  // [deg]
    QPlcOutput<double> m_dragCoefficient{this, "dragCoefficient"};              // [1]
    QPlcOutput<double> m_liftCoefficient{this, "liftCoefficient"};              // [1]
    QPlcOutput<double> m_aweCoefficient{this, "aweCoefficient"};                // [1]
    QPlcOutput<Vector> m_gravitationalForce{this, "gravitationalForce_earth"};  // [N]
    QPlcOutput<Vector> m_aerodynamicForce{this, "aerodynamicForce_earth"};      // [N]
    QPlcOutput<Vector> m_tetherForce{this, "tetherForce_earth"};                // [N]
    QPlcOutput<double> m_tetherLength{this, "tetherLength"};                    // [m]
    QPlcOutput<double> m_power{this, "power"};                                  // [W]
    QPlcOutput<double> m_averagePower{this, "averagePower"};                    // [W]
    QPlcOutput<double> m_energy{this, "energy"};                                // [J]
    QPlcOutput<bool> m_crashed{this, "crashed"};
    std::optional<QPlcOutput<double>> m_winchLoad;  // [N]

    std::vector<std::function<void(const KiteDetails &)>> m_optionOutputs;  // each holds its port
    std::optional<QPlcInput<double>> m_steering;                            // [-], -1 ... 1
    std::optional<QPlcInput<double>> m_turbines;                            // [-], drag coefficient
    std::optional<QPlcInput<bool>> m_release;                               // of the mast
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#include "CompactModelNode.h"

#include <memory>

namespace awe {

CompactModelNode::CompactModelNode(const KiteSimulation &simulation, WinchKind winch)
    : QPlcCompactSlaveNode(QStringLiteral("Model"), ErrorZeroOrderHold)
    , m_simulation(simulation)
    , m_tetherSpeed(this, winchSpeedSignal(winch))
{
    if (isDrive(winch))
        m_winchLoad.emplace(this, "winchLoad");
    addOptions();
}

void CompactModelNode::addOptions()
{
    const PlantOptions &options = m_simulation.options();
    if (options.steering.kind == SteeringKind::TurnRate)
        m_steering.emplace(this, steeringCommandSignal);
    if (options.hasTurbines)
        m_turbines.emplace(this, turbineCoefficientSignal);
    if (options.mast.isPresent)
        m_release.emplace(this, mastReleaseSignal);
    for (const OptionSignal &signal : modelSignals(options)) {
        const auto add = [&](const auto &read) {
            using Value = decltype(read(m_simulation.details()));
            const auto port = std::make_shared<QPlcOutput<Value>>(this, signal.name.constData());
            m_optionOutputs.push_back([read, port](const KiteDetails &details) { *port = read(details); });
        };
        std::visit(add, signal.read);
    }
}

PlantInputs CompactModelNode::commands() const
{
    PlantInputs commands;
    commands.pitchSpeed = m_pitchSpeed;
    commands.yawSpeed = m_yawSpeed;
    commands.tetherSpeed = m_tetherSpeed;
    if (m_steering)
        commands.steering = *m_steering;
    if (m_turbines)
        commands.turbineCoefficient = *m_turbines;
    if (m_release)
        commands.release = *m_release;
    return commands;
}

void CompactModelNode::collect(const PlantOutputs &outputs)
{
    m_position = outputs.position;
    m_velocity = outputs.velocity;
    m_windVelocity = outputs.inputs.windVelocity;
    m_controlOrientation = outputs.bodyControlOrientation;
    m_positionOrientation = outputs.bodyPositionOrientation;
    m_angleOfAttack = outputs.angleOfAttack;
    m_dragCoefficient = outputs.dragCoefficient;
    m_liftCoefficient = outputs.liftCoefficient;
    m_aweCoefficient = outputs.aweCoefficient;
    m_gravitationalForce = outputs.gravitationalForce;
    m_aerodynamicForce = outputs.aerodynamicForce;
    m_tetherForce = outputs.tetherForce;
    m_tetherLength = outputs.tetherLength;
    m_power = outputs.power;
    m_averagePower = outputs.averagePower;
    m_energy = outputs.energy;
    m_crashed = outputs.crashed;
    if (m_winchLoad)
        *m_winchLoad = outputs.groundTension;
    for (const auto &write : m_optionOutputs)
        write(m_simulation.details());
}

}  // namespace awe

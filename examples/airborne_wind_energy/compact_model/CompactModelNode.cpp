// SPDX-License-Identifier: Apache-2.0
#include "CompactModelNode.h"

namespace awe {

CompactModelNode::CompactModelNode(const KiteSimulation &simulation, WinchKind winch)
    : QPlcCompactSlaveNode(QStringLiteral("Model"), ErrorZeroOrderHold)
    , m_simulation(simulation)
    , m_tetherSpeed(this, winchSpeedSignal(winch))
{
    if (winch == WinchKind::Drive)
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
    for (OptionSignal &signal : modelSignals(options)) {
        OptionOutput output;
        if (signal.number)
            output.number = std::make_unique<QPlcOutput<double>>(this, signal.name.constData());
        else
            output.vector = std::make_unique<QPlcOutput<Vector>>(this, signal.name.constData());
        output.signal = std::move(signal);
        m_options.push_back(std::move(output));
    }
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
    for (const OptionOutput &output : m_options) {
        if (output.number)
            *output.number = output.signal.number(m_simulation.details());
        else
            *output.vector = output.signal.vector(m_simulation.details());
    }
}

}  // namespace awe

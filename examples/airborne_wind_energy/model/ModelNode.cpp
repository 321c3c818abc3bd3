// SPDX-License-Identifier: Apache-2.0
#include "ModelNode.h"

namespace awe {

namespace {

QPlcValue triple(const Eigen::Vector3d &vector)
{
    return std::array<double, 3>{vector.x(), vector.y(), vector.z()};
}

QPlcValue valueOf(const OptionSignal &signal, const KiteDetails &details)
{
    const auto read = [&details](const auto &reader) -> QPlcValue {
        if constexpr (std::is_same_v<decltype(reader(details)), Eigen::Vector3d>)
            return triple(reader(details));
        else
            return reader(details);
    };
    return std::visit(read, signal.read);
}

/// 0 for a signal that the plant does not have.
double realOf(const QPlcSignalList &inputs, QPlcSignalIndex index)
{
    return index == QPlcInvalidSignalIndex ? 0.0 : inputs.value(index).toReal();
}

}  // namespace

ModelNode::ModelNode(const KiteSimulation &simulation, WinchKind winch)
    : QPlcSlaveNode(QStringLiteral("Model"), ErrorZeroOrderHold)
    , m_simulation(simulation)
    , m_winch(winch)
    , m_optionSignals(modelSignals(simulation.options()))
{
}

QPlcSignalIndexList ModelNode::declareInputSignals()
{
    QPlcSignalIndexList inputs;
    m_pitchSpeed = inputs.insert(QStringLiteral("bodyControlPitchSpeed"));
    m_yawSpeed = inputs.insert(QStringLiteral("bodyControlYawSpeed"));
    m_tetherSpeed = inputs.insert(QString::fromLatin1(winchSpeedSignal(m_winch)));
    if (m_simulation.options().steering.kind == SteeringKind::TurnRate)
        m_steering = inputs.insert(QString::fromLatin1(steeringCommandSignal));
    if (m_simulation.options().hasTurbines)
        m_turbines = inputs.insert(QString::fromLatin1(turbineCoefficientSignal));
    if (m_simulation.options().mast.isPresent)
        m_release = inputs.insert(QString::fromLatin1(mastReleaseSignal));
    return inputs;
}

QPlcSignalIndexList ModelNode::declareOutputSignals()
{
    QPlcSignalIndexList outputs;
    m_position = outputs.insert(QStringLiteral("bodyPosition_earth"));
    m_velocity = outputs.insert(QStringLiteral("bodyVelocity_earth"));
    m_windVelocity = outputs.insert(QStringLiteral("windVelocity_earth"));
    m_controlOrientation = outputs.insert(QStringLiteral("bodyControlOrientation"));
    m_positionOrientation = outputs.insert(QStringLiteral("bodyPositionOrientation"));
    m_angleOfAttack = outputs.insert(QStringLiteral("angleOfAttack"));
    m_dragCoefficient = outputs.insert(QStringLiteral("dragCoefficient"));
    m_liftCoefficient = outputs.insert(QStringLiteral("liftCoefficient"));
    m_aweCoefficient = outputs.insert(QStringLiteral("aweCoefficient"));
    m_gravitationalForce = outputs.insert(QStringLiteral("gravitationalForce_earth"));
    m_aerodynamicForce = outputs.insert(QStringLiteral("aerodynamicForce_earth"));
    m_tetherForce = outputs.insert(QStringLiteral("tetherForce_earth"));
    m_tetherLength = outputs.insert(QStringLiteral("tetherLength"));
    m_power = outputs.insert(QStringLiteral("power"));
    m_averagePower = outputs.insert(QStringLiteral("averagePower"));
    m_energy = outputs.insert(QStringLiteral("energy"));
    m_crashed = outputs.insert(QStringLiteral("crashed"));
    if (isDrive(m_winch))
        m_winchLoad = outputs.insert(QStringLiteral("winchLoad"));
    m_optionIndices.clear();
    for (const OptionSignal &signal : m_optionSignals)
        m_optionIndices.push_back(outputs.insert(QString::fromLatin1(signal.name)));
    return outputs;
}

QPlcSignalList ModelNode::initialOutputSignals()
{
    return collect(m_simulation.reset());
}

PlantInputs ModelNode::commandsIn(const QPlcSignalList &inputs) const
{
    PlantInputs commands;
    commands.pitchSpeed = realOf(inputs, m_pitchSpeed);
    commands.yawSpeed = realOf(inputs, m_yawSpeed);
    commands.tetherSpeed = realOf(inputs, m_tetherSpeed);
    commands.steering = realOf(inputs, m_steering);
    commands.turbineCoefficient = realOf(inputs, m_turbines);
    commands.release = realOf(inputs, m_release) != 0.0;
    return commands;
}

QPlcSignalList ModelNode::realTimeout(const QPlcSignalList &inputSignals)
{
    return collect(m_simulation.step(commandsIn(inputSignals)));
}

QPlcSignalList ModelNode::outputSignals()
{
    return collect(m_simulation.outputs());
}

void ModelNode::updateStates(const QPlcSignalList &inputSignals)
{
    m_simulation.update(commandsIn(inputSignals));
}

QPlcSignalList ModelNode::collect(const PlantOutputs &outputs) const
{
    QPlcSignalList list;
    list.insert(m_position, triple(outputs.position));
    list.insert(m_velocity, triple(outputs.velocity));
    list.insert(m_windVelocity, triple(outputs.inputs.windVelocity));
    list.insert(m_controlOrientation, triple(outputs.bodyControlOrientation));
    list.insert(m_positionOrientation, triple(outputs.bodyPositionOrientation));
    list.insert(m_angleOfAttack, outputs.angleOfAttack);
    list.insert(m_dragCoefficient, outputs.dragCoefficient);
    list.insert(m_liftCoefficient, outputs.liftCoefficient);
    list.insert(m_aweCoefficient, outputs.aweCoefficient);
    list.insert(m_gravitationalForce, triple(outputs.gravitationalForce));
    list.insert(m_aerodynamicForce, triple(outputs.aerodynamicForce));
    list.insert(m_tetherForce, triple(outputs.tetherForce));
    list.insert(m_tetherLength, outputs.tetherLength);
    list.insert(m_power, outputs.power);
    list.insert(m_averagePower, outputs.averagePower);
    list.insert(m_energy, outputs.energy);
    list.insert(m_crashed, outputs.crashed);
    if (isDrive(m_winch))
        list.insert(m_winchLoad, outputs.groundTension);
    for (std::size_t i = 0; i < m_optionSignals.size(); ++i)
        list.insert(m_optionIndices[i], valueOf(m_optionSignals[i], m_simulation.details()));
    return list;
}

}  // namespace awe

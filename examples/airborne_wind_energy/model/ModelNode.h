// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSimulation.h"
#include "OptionSignals.h"
#include "PlantConfiguration.h"

#include <QtPlcCore>

namespace awe {

/// The plant as a node, written with lists of values: the way of QPlcSlaveNode. CompactModelNode
/// does the same with ports. Both may be two-phase: setTwoPhase().
class ModelNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    explicit ModelNode(const KiteSimulation &simulation, WinchKind winch = WinchKind::Ideal);

protected:
    QPlcSignalIndexList declareInputSignals() override;
    QPlcSignalIndexList declareOutputSignals() override;
    QPlcSignalList initialOutputSignals() override;
    QPlcSignalList realTimeout(const QPlcSignalList &inputSignals) override;
    QPlcSignalList outputSignals() override;
    void updateStates(const QPlcSignalList &inputSignals) override;

private:
    PlantInputs commandsIn(const QPlcSignalList &inputs) const;
    QPlcSignalList collect(const PlantOutputs &outputs) const;

    KiteSimulation m_simulation;
    const WinchKind m_winch;

    QPlcSignalIndex m_pitchSpeed = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_yawSpeed = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_tetherSpeed = QPlcInvalidSignalIndex;

    QPlcSignalIndex m_position = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_velocity = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_windVelocity = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_controlOrientation = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_positionOrientation = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_angleOfAttack = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_dragCoefficient = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_liftCoefficient = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_aweCoefficient = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_gravitationalForce = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_aerodynamicForce = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_tetherForce = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_tetherLength = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_power = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_averagePower = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_energy = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_crashed = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_winchLoad = QPlcInvalidSignalIndex;

    // Of the options of the plant
    const std::vector<OptionSignal> m_optionSignals;
    std::vector<QPlcSignalIndex> m_optionIndices;  // as many
    QPlcSignalIndex m_steering = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_turbines = QPlcInvalidSignalIndex;
    QPlcSignalIndex m_release = QPlcInvalidSignalIndex;
};

}  // namespace awe

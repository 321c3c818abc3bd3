// SPDX-License-Identifier: Apache-2.0
#include "FlightObserver.h"

#include "OptionSignals.h"

#include <stdexcept>

namespace awe {

FlightObserver::FlightObserver(const FlightStatisticsParameters &parameters, const PlantConfiguration &plant)
    : QPlcCompactSlaveNode(QStringLiteral("FlightObserver"), SilentZeroOrderHold)
    , m_statistics(parameters)
    , m_tetherSpeed(this, winchSpeedSignal(plant.winch))
{
    setReceivesQuality(true);
    if (plant.options.hasMachine) {
        m_electricalEnergy.emplace(this, "electricalEnergy");
        m_machineOff.emplace(this, machineOffSignal);
    }
    if (plant.options.hasTurbines)
        m_turbineEnergy.emplace(this, "turbineEnergy");
    if (plant.options.mast.isPresent) {
        m_docked.emplace(this, mastDockedSignal);
        m_crashed.emplace(this, "crashed");
        m_dockings.emplace(this, mastDockingsSignal);
        m_dockingSpeed.emplace(this, mastDockingSpeedSignal);
    }
}

void FlightObserver::requireGoodValues() const
{
    for (const QPlcPort *state : std::initializer_list<const QPlcPort *>{&m_position, &m_velocity, &m_windVelocity,
                                                                         &m_tetherForce, &m_power, &m_energy}) {
        if (state->quality().kind() == QPlcQuality::Safe)
            throw std::runtime_error(QStringLiteral("there is no good value of '%1'").arg(state->name()).toStdString());
    }
}

void FlightObserver::step(const QPlcCycle &)
{
    requireGoodValues();
    m_sawKite = m_sawKite || m_position.quality().kind() != QPlcQuality::Invalid;
    if (!m_sawKite)
        return;  // no model has come yet
    FlightSample sample;
    sample.position = m_position;
    sample.velocity = m_velocity;
    sample.windVelocity = m_windVelocity;
    sample.tetherForce = m_tetherForce;
    sample.tetherSpeed = m_tetherSpeed;
    sample.power = m_power;
    sample.energy = m_energy;
    if (m_electricalEnergy) {
        sample.electricalEnergy = *m_electricalEnergy;
        sample.isMachineOff = *m_machineOff;
    }
    if (m_turbineEnergy)
        sample.turbineEnergy = *m_turbineEnergy;
    if (m_docked) {
        sample.isDocked = *m_docked;
        sample.crashed = *m_crashed;
        sample.dockings = *m_dockings;
        sample.dockingSpeed = *m_dockingSpeed;
    }
    sample.flightPhase = m_phase;
    m_statistics.step(sample);
}

}  // namespace awe

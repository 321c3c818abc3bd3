// SPDX-License-Identifier: Apache-2.0
#include "FlightObserver.h"

namespace awe {

namespace {

FlightStatisticsParameters withWindSpeed(double speed)
{
    FlightStatisticsParameters parameters;
    parameters.nominalWindSpeed = speed;
    return parameters;
}

}  // namespace

FlightObserver::FlightObserver(double nominalWindSpeed)
    : QPlcCompactSlaveNode(QStringLiteral("FlightObserver"), SilentZeroOrderHold)
    , m_statistics(withWindSpeed(nominalWindSpeed))
{
}

void FlightObserver::step(const QPlcCycle &)
{
    FlightSample sample;
    sample.position = m_position;
    sample.windVelocity = m_windVelocity;
    sample.tetherForce = m_tetherForce;
    sample.tetherSpeed = m_tetherSpeed;
    sample.power = m_power;
    sample.energy = m_energy;
    sample.flightPhase = m_phase;
    m_statistics.step(sample);
}

}  // namespace awe

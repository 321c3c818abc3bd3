// SPDX-License-Identifier: Apache-2.0
#include "WinchObserver.h"

#include "WinchDrive.h"

namespace awe {

WinchObserver::WinchObserver()
    : QPlcCompactSlaveNode(QStringLiteral("WinchObserver"), SilentZeroOrderHold)
{
    setReceivesQuality(true);
}

void WinchObserver::step(const QPlcCycle &cycle)
{
    WinchSample sample;
    sample.time = cycle.dt() * double(cycle.missedCycles() + 1);
    sample.wantedSpeed = m_wantedSpeed;
    sample.speed = m_speed;
    sample.position = m_position;
    sample.current = m_current;
    sample.electricalPower = m_electricalPower;
    sample.tetherLength = m_tetherLength;
    sample.mechanicalEnergy = m_energy;
    sample.isEnabled = m_speed.quality().isUsable() && m_state == qint8(DriveState::Enabled);
    m_statistics.step(sample);
}

QJsonObject WinchObserver::report() const
{
    const WinchReport winch = m_statistics.report();
    return {{QStringLiteral("mechanical_energy_J"), winch.mechanicalEnergy},
            {QStringLiteral("electrical_energy_J"), winch.electricalEnergy},
            {QStringLiteral("losses_J"), winch.losses},
            {QStringLiteral("speed_error_rms_m_s"), winch.speedError},
            {QStringLiteral("speed_error_max_m_s"), winch.largestSpeedError},
            {QStringLiteral("position_error_m"), winch.positionError},
            {QStringLiteral("max_current_A"), winch.largestCurrent},
            {QStringLiteral("disabled_s"), winch.timeDisabled},
            {QStringLiteral("interruptions"), winch.interruptions}};
}

}  // namespace awe

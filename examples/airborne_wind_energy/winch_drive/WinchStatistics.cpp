// SPDX-License-Identifier: Apache-2.0
#include "WinchStatistics.h"

#include <algorithm>
#include <cmath>

namespace awe {

void WinchStatistics::step(const WinchSample &sample)
{
    if (m_count++ == 0)
        m_first = sample;
    m_electricalEnergy += sample.electricalPower * sample.time;
    m_report.largestCurrent = std::max(m_report.largestCurrent, std::abs(sample.current));
    if (sample.isEnabled) {
        const double error = sample.speed - sample.wantedSpeed;
        if (m_enabledTime == 0.0)
            m_firstEnabled = sample;
        m_lastEnabled = sample;
        m_squaredError += error * error * sample.time;
        m_enabledTime += sample.time;
        m_report.largestSpeedError = std::max(m_report.largestSpeedError, std::abs(error));
    } else if (m_enabledTime > 0.0) {
        m_report.timeDisabled += sample.time;
        m_report.interruptions += m_last.isEnabled ? 1 : 0;
    }
    m_last = sample;
}

WinchReport WinchStatistics::report() const
{
    WinchReport report = m_report;
    report.mechanicalEnergy = m_last.mechanicalEnergy - m_first.mechanicalEnergy;
    report.electricalEnergy = m_electricalEnergy;
    report.losses = report.mechanicalEnergy - report.electricalEnergy;
    report.speedError = m_enabledTime > 0.0 ? std::sqrt(m_squaredError / m_enabledTime) : 0.0;
    report.positionError = (m_lastEnabled.position - m_firstEnabled.position)
        - (m_lastEnabled.tetherLength - m_firstEnabled.tetherLength);
    return report;
}

}  // namespace awe

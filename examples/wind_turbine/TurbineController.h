// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <algorithm>

/// Torque and collective pitch of a wind turbine of 5 MW with variable speed.
///
/// Below rated speed the torque holds the best tip speed ratio: T = k * w^2. At rated speed the
/// torque stays at its limit, and a PI controller pitches the blades. The gain falls with the pitch
/// angle, because the same step of pitch then changes the torque of the rotor more.
class TurbineController : public QPlcCompactSlaveNode
{
public:
    TurbineController()
        : QPlcCompactSlaveNode("TurbineController")
    {
    }

private:
    static constexpr double ratedSpeed = 122.9;     // [rad/s] of the generator
    static constexpr double ratedTorque = 43.09e3;  // [N m]
    static constexpr double torqueGain = 2.33;      // [N m s^2/rad^2]
    static constexpr double proportional = 0.0188;  // [s]
    static constexpr double integral = 0.0081;      // [1]
    static constexpr double doubledAt = 0.1099;     // [rad] where the turbine is twice as sensitive
    static constexpr double largestPitch = 1.5708;  // [rad]

    QPlcInput<double> m_speed{this, "generatorSpeed"};                     // [rad/s]
    QPlcInput<std::array<double, 3>> m_pitch{this, "bladePitch"};          // [rad]
    QPlcOutput<double> m_torque{this, "generatorTorque"};                  // [N m]
    QPlcOutput<std::array<double, 3>> m_demand{this, "bladePitchDemand"};  // [rad]
    double m_integral = 0.0;                                               // [rad]

    void reset() override
    {
        m_integral = 0.0;
        m_torque = 0.0;
        m_demand = std::array<double, 3>{};
    }
    void initialized() override { m_integral = m_pitch.value()[0]; }  // no step at the begin
    void step(const QPlcCycle &cycle) override
    {
        const double error = m_speed - ratedSpeed;
        const double schedule = 1.0 / (1.0 + m_pitch.value()[0] / doubledAt);
        m_integral = std::clamp(m_integral + integral * schedule * error * cycle.dt(), 0.0, largestPitch);
        const double pitch = std::clamp(m_integral + proportional * schedule * error, 0.0, largestPitch);
        m_demand = std::array<double, 3>{pitch, pitch, pitch};
        m_torque = std::min(ratedTorque, torqueGain * m_speed * m_speed);
    }
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

/// The node that is tested: reels out 1 m/s, and stands still in its safe state.
class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        activateWatchdog(std::chrono::milliseconds(50));
    }
    double speed = 0.0;  // [m/s] of the drive
private:
    QPlcOutput<double> m_length{this, "tetherLength"};  // [m]
    void reset() override { m_length = 300.0; }
    void step(const QPlcCycle &cycle) override { speed = 1.0, m_length = m_length + speed * cycle.dt(); }
    void safeState(SafeStateReason) override { speed = 0.0; }
};

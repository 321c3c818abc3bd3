// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WinchDrive.h"

#include <QtPlcCore>

namespace awe {

/// The controller of the drive as a node of a plant of its own, which is the drive: its other node
/// is the bus.
class WinchDriveNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit WinchDriveNode(const WinchDriveParameters &parameters);

    /// \pre no cycle runs
    const WinchDrive &drive() const { return m_drive; }

private:
    void reset() override;
    void step(const QPlcCycle &cycle) override;
    WinchDriveInputs inputs() const;
    void send();

    WinchDrive m_drive;

    QPlcInput<bool> m_enable{this, "commandEnable"};
    QPlcInput<double> m_speedSetpoint{this, "commandSpeed"};  // [rad/s]
    QPlcInput<double> m_tetherForce{this, "tetherForce"};     // [N]

    QPlcOutput<qint8> m_state{this, "driveState"};
    QPlcOutput<qint8> m_stop{this, "driveStop"};
    QPlcOutput<bool> m_brake{this, "driveBrake"};
    QPlcOutput<double> m_speed{this, "driveSpeed"};        // [rad/s]
    QPlcOutput<double> m_current{this, "driveCurrent"};    // [A]
    QPlcOutput<double> m_position{this, "drivePosition"};  // [rad]
    QPlcOutput<double> m_power{this, "drivePower"};        // [W]
};

}  // namespace awe

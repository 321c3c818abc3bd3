// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DriveProfile.h"

#include <QtPlcCore>

namespace awe {

/// The profile CiA 402 as a node between the CANopen bus and the controller of the drive.
class DriveProfileNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    DriveProfileNode();

private:
    void reset() override;
    void step(const QPlcCycle &cycle) override;

    DriveProfile m_profile;

    QPlcInput<quint16> m_controlword{this, "controlword"};
    QPlcInput<qint8> m_wantedMode{this, "wantedMode"};
    QPlcInput<double> m_targetVelocity{this, "targetVelocity"};  // [rad/s]
    QPlcInput<qint8> m_driveState{this, "driveState"};

    QPlcOutput<quint16> m_statusword{this, "statusword"};
    QPlcOutput<qint8> m_mode{this, "mode"};
    QPlcOutput<bool> m_enable{this, "commandEnable"};
    QPlcOutput<double> m_speed{this, "commandSpeed"};  // [rad/s]
};

}  // namespace awe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WinchStatistics.h"

#include <QtPlcCore>

#include <QtCore/QJsonObject>

namespace awe {

/// Watches the winch drive of a flight from its signals: a node without outputs in the process of
/// the master.
class WinchObserver : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    WinchObserver();

    /// The figures of the flight, for its report. \pre no cycle runs
    QJsonObject report() const;

private:
    void reset() override { m_statistics.reset(); }
    void step(const QPlcCycle &cycle) override;

    WinchStatistics m_statistics;

    QPlcInput<double> m_wantedSpeed{this, "tetherSpeed"};               // [m/s]
    QPlcInput<double> m_tetherLength{this, "tetherLength"};             // [m]
    QPlcInput<double> m_energy{this, "energy"};                         // [J]
    QPlcInput<qint8> m_state{this, "winchState"};                       // DriveState
    QPlcInput<double> m_speed{this, "winchSpeed"};                      // [m/s]
    QPlcInput<double> m_position{this, "winchPosition"};                // [m]
    QPlcInput<double> m_current{this, "winchCurrent"};                  // [A]
    QPlcInput<double> m_electricalPower{this, "winchElectricalPower"};  // [W]
};

}  // namespace awe

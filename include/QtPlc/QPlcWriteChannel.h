// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"

/// A value that goes to a device: `QPlcWriteChannel m_torque{this, "torque"};  // [N m]`
///
/// It is a number in the unit of the device. Its value is that of its signal while the node computes, and the safe value (of the configuration, else of the signal table)
/// before, after, and whenever something is wrong. Until one of these is known it has no value, and the device is left alone.
class QTPLC_HARDWARE_EXPORT QPlcWriteChannel final : public QPlcChannel
{
public:
    QPlcWriteChannel(QPlcDriver *driver, const QString &name);

    bool hasValue() const { return m_hasValue; }
    /// \pre hasValue()
    double value() const { return m_value; }
    /// value() >= 0.5: for switches.
    bool isOn() const { return m_value >= 0.5; }
    /// Whether the value is the safe one because the node is in its safe state or does not run.
    bool isSafe() const { return m_isSafe; }

private:
    friend class qplc::DriverRunner;

    double m_value = 0.0;
    bool m_hasValue = false;
    bool m_isSafe = true;
};

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenConfiguration.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/can/CanFrame.h"

#include <memory>
#include <vector>

class QPlcDriver;

namespace qplc {

/// The channels of a drive (profile 402), and its axis. Without the profile it has none, and does
/// nothing.
///
/// Write channels: enable, quickStop, faultReset, home, mode, velocity, torque, position. Read
/// channels: state, enabled, faulty, limited, blocked, homed, and what the drive measures:
/// velocity, torque, position, mode, statusword, errorCode.
class CanOpenAxisChannels
{
public:
    explicit CanOpenAxisChannels(QPlcDriver *driver)
        : m_driver(driver)
    {
    }

    void setPlan(const CanOpenConfiguration &plan);
    /// What the axis itself knows. \return null: it is no such channel
    QPlcReadChannel *readChannel(const QString &name);
    /// \return null: it is no such channel, or no PDO takes it (\a error)
    QPlcWriteChannel *writeChannel(const QString &name, QString *error);
    /// The object that a name of a drive means: "velocity" is 606C:00. Others stay as they are.
    QString objectOf(const QString &name) const;
    QStringList names(bool isRead) const;

    // ---- in the cycle; without memory ----
    void begin() noexcept;
    /// Takes a PDO of the device.
    void take(const Pdo &pdo, const CanFrame &frame, qint64 time) noexcept;
    void step(qint64 now) noexcept;
    /// From now on the outputs are those of the safe state.
    void stop() noexcept;
    /// Whether somebody commands the drive, and all of it is known.
    bool hasCommand() const noexcept;
    /// Null while hasCommand() is false.
    const AxisOutputs *outputs() const noexcept { return hasCommand() ? &m_outputs : nullptr; }
    /// Gives values to the read channels.
    void show(qint64 now) noexcept;
    bool isAxis() const noexcept { return m_isAxis; }
    /// Whether the drive has told a state after \a since [ns], in which it does what was commanded:
    /// in the safe state one without operation.
    bool hasAnswered(qint64 since) const noexcept;
    AxisState state() const noexcept;

private:
    /// Channels that are written, in the order of their names.
    enum Order : quint8 { Enable, QuickStop, FaultReset, Home, Mode, Velocity, Torque, Position, OrderCount };
    /// Objects that the axis needs.
    enum Feedback : quint8 { Statusword, ModeDisplay, ActualPosition, FeedbackCount };
    struct Place
    {
        int pdo = -1;  // number of the TPDO; -1: it is in none
        int first = 0;
        RawNumber number;
        qint64 freshTime = 0;  // [ns]; 0: as long as the device lives
    };
    struct Shown
    {
        int kind;
        std::unique_ptr<QPlcReadChannel> channel;
    };

    AxisCommand command() const noexcept;
    bool isOn(Order order) const noexcept;
    double valueOf(Order order, double otherwise) const noexcept;

    QPlcDriver *m_driver;
    bool m_isAxis = false;
    bool m_hasTarget[OrderCount] = {};
    AxisMode m_mode = AxisMode::SyncVelocity;
    Cia402Axis m_axis;
    AxisFeedback m_feedback;
    AxisOutputs m_outputs;
    bool m_isSafe = true;     // the last command
    qint64 m_statusTime = 0;  // [ns]
    Place m_places[FeedbackCount];
    std::unique_ptr<QPlcWriteChannel> m_orders[OrderCount];
    std::vector<Shown> m_shown;
};

}  // namespace qplc

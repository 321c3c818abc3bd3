// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcHardwareGlobal.h"

#include <QtCore/QString>

class QPlcDriver;

namespace qplc {
class DriverRunner;
}

/// One value of a device, under the name that the device gives it: base of QPlcReadChannel and
/// QPlcWriteChannel.
///
/// \code
/// class Relay : public QPlcDriver
/// {
/// public:
///     Relay() : QPlcDriver(EveryCycle) {}
///
/// private:
///     QPlcReadChannel m_current{this, "current"};  // [A]
///     QPlcWriteChannel m_on{this, "on"};           // 0 or 1
///     void configure(QPlcDriverSettings &) override {}
///     bool open() override { return true; }
///     void close() override {}
/// };
/// \endcode
///
/// A channel registers itself at its driver in its constructor. You can neither copy nor move it,
/// and it must not outlive its driver. The configuration of the node ties channels to signals
/// (QPlcHardwareNode).
///
/// \threadsafe no: while the device is open use it in the thread that calls QPlcDriver::read() and
///     write(), else in the thread of the driver
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcChannel
{
public:
    /// Direction of the value.
    enum Direction : quint8 {
        Read,  ///< from the device
        Write  ///< to the device
    };

    QPlcChannel(const QPlcChannel &) = delete;
    QPlcChannel &operator=(const QPlcChannel &) = delete;

    /// Returns the name that the configuration uses.
    QString name() const { return m_name; }
    /// Returns Read for a value from the device, Write for a value to it.
    Direction direction() const { return m_direction; }
    /// Returns true if the configuration ties the channel to a signal, watches it, or sets its safe
    /// value. A driver need not read a channel that is not wired. Valid when all channels have been
    /// configured.
    bool isWired() const { return m_isWired; }

protected:
    /// Registers the channel at its driver.
    /// \param driver  outlives the channel
    /// \param name  unique among the channels of one direction of the driver
    QPlcChannel(QPlcDriver *driver, const QString &name, Direction direction);
    /// Removes the channel from its driver.
    ~QPlcChannel();

private:
    friend class QPlcDriver;
    friend class QPlcReadChannel;
    friend class qplc::DriverRunner;

    QPlcDriver *m_driver;
    QString m_name;
    Direction m_direction;
    bool m_isWired = false;
};

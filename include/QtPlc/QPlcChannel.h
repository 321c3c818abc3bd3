// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcHardwareGlobal.h"

#include <QtCore/QString>

class QPlcDriver;

namespace qplc {
class DriverRunner;
}

/// One value of a device, under the name that the device gives it: see QPlcReadChannel and QPlcWriteChannel.
///
/// A channel registers itself at its driver when it is made; it is neither copied nor moved, and lives no longer than the driver. Which of them are tied to plc signals
/// is said by the configuration of the node (QPlcHardwareNode). Threads: that of QPlcDriver::read() and write() while the device is open, else that of the driver.
class QTPLC_HARDWARE_EXPORT QPlcChannel
{
public:
    enum Direction : quint8 {
        Read,  ///< from the device
        Write  ///< to the device
    };

    QPlcChannel(const QPlcChannel &) = delete;
    QPlcChannel &operator=(const QPlcChannel &) = delete;

    QString name() const { return m_name; }
    Direction direction() const { return m_direction; }
    /// Whether the configuration ties it to a signal, watches it, or says its safe value. What is not wired need not be read.
    bool isWired() const { return m_isWired; }

protected:
    QPlcChannel(QPlcDriver *driver, const QString &name, Direction direction);
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"

#include <chrono>
#include <limits>

/// A value that comes from a device: `QPlcReadChannel m_angle{this, "angle"};  // [rad]`
///
/// It is a number in the unit of the device; the configuration converts it to that of its signal. A value is fresh for its timeout, counted from the time at which it was
/// measured; then, and before the first one, the signal is told to have none (QPlcQuality::Invalid), so that its readers keep the last good value for `hold` cycles and then
/// get the safe one.
class QTPLC_HARDWARE_EXPORT QPlcReadChannel final : public QPlcChannel
{
public:
    /// The time of a value that there is not.
    static constexpr qint64 Never = std::numeric_limits<qint64>::min();

    QPlcReadChannel(QPlcDriver *driver, const QString &name);

    /// A new value, measured now.
    void set(double value);
    /// A new value. \param time  when it was measured, on the clock of QPlcDriver::now() [ns]
    void set(double value, qint64 time)
    {
        m_value = value;
        m_time = time;
    }
    /// There is no value any more: the wire is broken, the device says so itself, ...
    void invalidate() { m_time = Never; }

    /// How long a value is fresh; 0: for ever. Unless set it is that of the driver (QPlcDriver::timeout()).
    void setTimeout(std::chrono::nanoseconds timeout) { m_timeout = timeout.count(); }

    double value() const { return m_value; }
    /// When the value was measured [ns], or Never.
    qint64 time() const { return m_time; }

private:
    friend class qplc::DriverRunner;

    double m_value = 0.0;
    qint64 m_time = Never;  // [ns]
    qint64 m_timeout = -1;  // [ns]; -1: that of the driver
};

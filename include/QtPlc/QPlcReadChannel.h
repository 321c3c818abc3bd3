// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"

#include <chrono>
#include <limits>
#include <optional>

/// A value that comes from a device.
///
/// \code
/// class Scale : public QPlcDriver
/// {
/// public:
///     Scale() : QPlcDriver(OwnPace) {}
///
/// private:
///     QPlcReadChannel m_force{this, "force"};  // [N]
///     void configure(QPlcDriverSettings &) override {}
///     bool open() override { return true; }
///     void close() override {}
///     bool read() override
///     {
///         m_force.set(12.5);
///         return true;
///     }
/// };
/// \endcode
///
/// It is a number in the unit of the device; the configuration converts it to that of its signal. A
/// value is fresh for its timeout, counted from the time at which it was measured. Before the first
/// value and after the timeout the output of the node has the quality Invalid. Readers of the
/// signal then keep the last good value for `hold` cycles and get the safe value after that.
///
/// \threadsafe no: see QPlcChannel
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcReadChannel final : public QPlcChannel
{
public:
    /// The time() of a channel that has no value.
    static constexpr qint64 Never = std::numeric_limits<qint64>::min();

    /// Registers the channel at its driver, without a value.
    /// \param driver  outlives the channel
    /// \param name  for the configuration
    QPlcReadChannel(QPlcDriver *driver, const QString &name);

    /// Sets a value that was measured now: at QPlcDriver::now().
    /// \param value  in the unit of the device
    void set(double value);
    /// Sets a value that was measured at another time.
    /// \param value  in the unit of the device
    /// \param time  on the clock of QPlcDriver::now() [ns]
    void set(double value, qint64 time)
    {
        m_value = value;
        m_time = time;
    }
    /// Removes the value, for example because a wire is broken or the device reports an error.
    void invalidate() { m_time = Never; }

    /// Sets which value the channel has when its wire is torn. If such a channel is a `safeStop`
    /// and this value is 0, the node warns: a torn wire would be a button that is not pressed.
    /// \param value  NaN: an open wire floats, and the value is undefined
    void setTornValue(double value) { m_tornValue = value; }
    /// Returns the value of a torn wire; empty (default): not known.
    std::optional<double> tornValue() const { return m_tornValue; }

    /// Sets for how long a value is fresh; by default it is QPlcDriver::timeout(). Call it before
    /// the device is opened.
    /// \param timeout  0: forever
    void setTimeout(std::chrono::nanoseconds timeout) { m_timeout = timeout.count(); }

    /// Returns the last value, in the unit of the device, also if it is not fresh.
    double value() const { return m_value; }
    /// Returns when the value was measured [ns], or Never.
    qint64 time() const { return m_time; }

private:
    friend class qplc::DriverRunner;

    double m_value = 0.0;
    qint64 m_time = Never;  // [ns]
    qint64 m_timeout = -1;  // [ns]; -1: that of the driver
    std::optional<double> m_tornValue;
};

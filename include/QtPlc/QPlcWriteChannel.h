// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"

#include <limits>
#include <optional>

/// A value that goes to a device.
///
/// \code
/// class Lamp : public QPlcDriver
/// {
/// public:
///     Lamp() : QPlcDriver(EveryCycle) {}
///
/// private:
///     QPlcWriteChannel m_lamp{this, "lamp"};
///     void configure(QPlcDriverSettings &) override {}
///     bool open() override { return true; }
///     void close() override {}
///     bool write() override
///     {
///         if (m_lamp.hasValue())
///             switchLamp(m_lamp.isOn());
///         return true;
///     }
///     static void switchLamp(bool) {}
/// };
/// \endcode
///
/// It is a number in the unit of the device. While the node computes, its value comes from its
/// signal. Before, after, and in the safe state it is the safe value (of the configuration, else of
/// the signal table). It has no value until one of these is known: leave the device alone then.
///
/// \threadsafe no: see QPlcChannel
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcWriteChannel final : public QPlcChannel
{
public:
    /// Registers the channel at its driver, without a value.
    /// \param driver  outlives the channel
    /// \param name  for the configuration
    QPlcWriteChannel(QPlcDriver *driver, const QString &name);

    /// Sets the range of values that the device can take; by default there is no limit. A safe
    /// value or constant of a configuration outside of it is an error of that file. Values of
    /// signals are not checked: limit them in write(). Call it in QPlcDriver::configure() or
    /// channel().
    /// \param minimum,  maximum in the unit of the device, both included
    void setRange(double minimum, double maximum)
    {
        m_minimum = minimum;
        m_maximum = maximum;
    }
    /// Returns the lowest value that the device can take; default: minus infinity.
    double minimum() const { return m_minimum; }
    /// Returns the highest value that the device can take; default: infinity.
    double maximum() const { return m_maximum; }

    /// Sets which value the device has while no program drives it. If the safe value differs, the
    /// node warns: it would end with the power or the program.
    void setRestValue(double value) { m_restValue = value; }
    /// Returns the value of a device that is not driven; empty (default): not known.
    std::optional<double> restValue() const { return m_restValue; }

    /// Returns true if there is a value to write.
    bool hasValue() const { return m_hasValue; }
    /// Returns the value, in the unit of the device.
    /// \pre hasValue()
    double value() const { return m_value; }
    /// Returns true if value() is at least 0.5: for switches.
    bool isOn() const { return m_value >= 0.5; }
    /// Returns true if the value is the safe one, because the node does not compute or is in its
    /// safe state.
    bool isSafe() const { return m_isSafe; }

private:
    friend class qplc::DriverRunner;

    double m_minimum = -std::numeric_limits<double>::infinity();
    double m_maximum = std::numeric_limits<double>::infinity();
    std::optional<double> m_restValue;
    double m_value = 0.0;
    bool m_hasValue = false;
    bool m_isSafe = true;
};

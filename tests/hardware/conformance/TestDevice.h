// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QMap>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <functional>
#include <memory>
#include <optional>

/// A device as the conformance test of the drivers holds it: what is at the other end of its wires,
/// and its plug.
///
/// Each driver has one that is fake, and one that is real, if the computer has the device: an
/// environment variable names it then (see addRealDevices of each kind).
class TestDevice
{
public:
    TestDevice() = default;
    virtual ~TestDevice() = default;
    TestDevice(const TestDevice &) = delete;
    TestDevice &operator=(const TestDevice &) = delete;

    /// Kind of the driver and keys of its section.
    virtual QString kind() const = 0;
    virtual QByteArray keys() const = 0;
    /// What errors have to name.
    virtual QString name() const = 0;
    /// Channels that are read; each of them gets its values by give().
    virtual QStringList inputs() const = 0;
    /// Channels that are written.
    virtual QStringList outputs() const { return {}; }
    bool hasOutputs() const { return !outputs().isEmpty(); }
    bool hasOutputsAndIsPluggable() const { return hasOutputs() && isPluggable(); }
    /// Two values that the channels can have.
    virtual QVector<double> values() const = 0;

    /// The device is there from now on, and answers. \return whether it is
    virtual bool plugIn() = 0;
    /// \return false when that cannot be done with this device; isPluggable() is false then, too
    virtual bool unplug() { return false; }
    virtual bool isPluggable() const { return true; }
    /// It is there and has nothing to say, until it is plugged in anew. \return false when that
    /// cannot be; isEverSilent() is false then, too
    virtual bool fallSilent() { return false; }
    virtual bool isEverSilent() const { return true; }
    /// Called again and again: the device does what it does by itself.
    virtual void live() {}

    /// The device measures \a value from now on.
    virtual void give(const QString &input, double value) = 0;
    /// Returns the value that the device has got, or no value if it was left alone.
    virtual std::optional<double> taken(const QString & /*output*/) { return std::nullopt; }
    /// Whether taken() is still right when nobody has the device.
    virtual bool remembersOutputs() const { return true; }
};

/// Name of a row of the test: the device that it is for.
using TestDevices = QMap<QString, std::function<std::unique_ptr<TestDevice>()>>;

/// The parts of an environment variable, "gpiochip0:4" for example. Empty: it is not set.
inline QStringList testDeviceParts(const char *variable)
{
    return QString::fromLocal8Bit(qgetenv(variable)).split(QLatin1Char(':'), Qt::SkipEmptyParts);
}

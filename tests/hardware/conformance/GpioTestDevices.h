// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/gpio/FakeGpioChip.h"

#include <QtCore/QFile>

/// A board with an input and an output.
class FakeGpioDevice : public TestDevice
{
public:
    explicit FakeGpioDevice(const QString &kind)
        : m_kind(kind)
    {
    }

    QString kind() const override { return m_kind; }
    QByteArray keys() const override { return "device = fake:board\ninput.in = 2\noutput.out = 5\n"; }
    QString name() const override { return QStringLiteral("fake:board"); }
    QStringList inputs() const override { return {QStringLiteral("in")}; }
    QStringList outputs() const override { return {QStringLiteral("out")}; }
    QVector<double> values() const override { return {1.0, 0.0}; }

    bool plugIn() override
    {
        QString error;
        return m_memory.create(name(), 8, &error);
    }
    bool unplug() override
    {
        qplc::FakeMemory::remove(name());
        return true;
    }
    bool isEverSilent() const override { return false; }
    void give(const QString &, double value) override
    {
        m_memory.at(2) = value >= 0.5 ? qplc::FakeGpioChip::Pulled : 0;
    }
    std::optional<double> taken(const QString &) override
    {
        const quint8 byte = m_memory.at(5);
        if (!(byte & qplc::FakeGpioChip::IsOutput))
            return std::nullopt;
        return byte & qplc::FakeGpioChip::Driven ? 1.0 : 0.0;
    }

private:
    const QString m_kind;
    qplc::FakeMemory m_memory;
};

/// A chip of the module gpio-sim of the kernel: QTPLC_TEST_GPIO=CHIP:FOLDER:INPUT:OUTPUT, with its
/// folder in sysfs, which has sim_gpioN/pull and sim_gpioN/value:
/// `gpiochip0:/sys/devices/platform/gpio-sim.0/gpiochip0:2:5`
class SimulatedGpioDevice : public TestDevice
{
public:
    explicit SimulatedGpioDevice(const QStringList &parts)
        : m_parts(parts)
    {
    }

    QString kind() const override { return QStringLiteral("gpio"); }
    QByteArray keys() const override
    {
        return QStringLiteral("device = %1\ninput.in = %2\noutput.out = %3\n")
            .arg(m_parts[0], m_parts[2], m_parts[3])
            .toUtf8();
    }
    QString name() const override { return m_parts[0]; }
    QStringList inputs() const override { return {QStringLiteral("in")}; }
    QStringList outputs() const override { return {QStringLiteral("out")}; }
    QVector<double> values() const override { return {1.0, 0.0}; }

    bool plugIn() override { return QFile::exists(file(2, "pull")) && QFile::exists(file(3, "value")); }
    bool isPluggable() const override { return false; }
    bool isEverSilent() const override { return false; }
    void give(const QString &, double value) override
    {
        QFile pull(file(2, "pull"));
        if (!pull.open(QIODevice::WriteOnly) || pull.write(value >= 0.5 ? "pull-up" : "pull-down") < 0)
            qFatal("cannot write %s", qPrintable(pull.fileName()));
    }
    std::optional<double> taken(const QString &) override
    {
        QFile value(file(3, "value"));
        return value.open(QIODevice::ReadOnly) ? std::optional<double>(value.readAll().trimmed().toDouble())
                                               : std::nullopt;
    }
    bool remembersOutputs() const override { return false; }  // who lets a line go, leaves it to its pull

private:
    QString file(int part, const char *which) const
    {
        return QStringLiteral("%1/sim_gpio%2/%3").arg(m_parts[1], m_parts[part], QLatin1String(which));
    }
    const QStringList m_parts;
};

inline void addGpioDevices(TestDevices *devices)
{
    for (const char *kind : {"gpio", "gpio-expander"})
        devices->insert(QLatin1String(kind) + QStringLiteral(", fake"),
                        [kind] { return std::make_unique<FakeGpioDevice>(QString::fromLatin1(kind)); });
    const QStringList parts = testDeviceParts("QTPLC_TEST_GPIO");
    if (parts.size() == 4)
        devices->insert(QStringLiteral("gpio, gpio-sim"),
                        [parts] { return std::make_unique<SimulatedGpioDevice>(parts); });
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../sysfs/SysfsTree.h"
#include "TestDevice.h"

/// A converter of the class IIO.
class SysfsConverterDevice : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("sysfs"); }
    QByteArray keys() const override { return "root = fake:converter\ndevice = iio:ads1115\n"; }
    QString name() const override { return QStringLiteral("iio:ads1115"); }
    QStringList inputs() const override { return {QStringLiteral("voltage0")}; }
    QVector<double> values() const override { return {0.5, 4.095}; }

    bool plugIn() override
    {
        m_tree.write(m_folder + "name", "ads1115\n");
        m_tree.write(m_folder + "in_voltage_scale", "0.5\n");
        m_tree.write(m_folder + "in_voltage0_raw", "0\n");
        return true;
    }
    bool unplug() override { return m_tree.remove(); }
    bool fallSilent() override
    {
        m_tree.write(m_folder + "in_voltage0_raw", "");
        return true;
    }
    void give(const QString &, double value) override
    {
        m_tree.write(m_folder + "in_voltage0_raw", QByteArray::number(qRound(value * 2000.0)));
    }

private:
    const QString m_folder = QStringLiteral("bus/iio/devices/iio:device0/");
    const SysfsTree m_tree{QStringLiteral("fake:converter")};
};

/// A channel of a PWM chip that is there already.
class SysfsPwmDevice : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("sysfs"); }
    QByteArray keys() const override { return "root = fake:pwm\ndevice = pwm:bench.pwm\nperiod = 1 ms\n"; }
    QString name() const override { return QStringLiteral("pwm:bench.pwm"); }
    QStringList inputs() const override { return {QStringLiteral("pwm0")}; }
    QStringList outputs() const override { return {QStringLiteral("pwm0")}; }
    QVector<double> values() const override { return {0.25, 0.75}; }

    bool plugIn() override
    {
        m_tree.remove();
        for (const auto &[file, text] :
             {std::pair{"period", "1000000"}, {"duty_cycle", "0"}, {"polarity", "normal"}, {"enable", "0"}})
            m_tree.write(m_folder + file, text);
        m_tree.link("class/pwm/pwmchip0", "devices/bench.pwm/pwm/pwmchip0");
        m_tree.link("class/pwm/pwmchip0/device", "devices/bench.pwm");
        return true;
    }
    bool unplug() override { return m_tree.remove(); }
    bool isEverSilent() const override { return false; }
    void give(const QString &, double value) override
    {
        m_tree.write(m_folder + "duty_cycle", QByteArray::number(qRound(value * 1e6)));
        m_tree.write(m_folder + "enable", "1");
    }
    std::optional<double> taken(const QString &) override
    {
        if (m_tree.read(m_folder + "enable").trimmed() != "1")
            return std::nullopt;
        return m_tree.read(m_folder + "duty_cycle").toDouble() / 1e6;
    }

private:
    const QString m_folder = QStringLiteral("devices/bench.pwm/pwm/pwmchip0/pwm0/");
    const SysfsTree m_tree{QStringLiteral("fake:pwm")};
};

inline void addSysfsDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("sysfs, fake converter"), [] { return std::make_unique<SysfsConverterDevice>(); });
    devices->insert(QStringLiteral("sysfs, fake PWM"), [] { return std::make_unique<SysfsPwmDevice>(); });
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../sysfs/SysfsTree.h"
#include "TestDevice.h"

#include <QtCore/QProcess>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

/// A converter of the class IIO.
class SysfsConverterDevice : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("sysfs"); }
    QByteArray keys() const override { return "root = fake:converter\ndevice = iio:ads1015\n"; }
    QString name() const override { return QStringLiteral("iio:ads1015"); }
    QStringList inputs() const override { return {QStringLiteral("voltage0")}; }
    QVector<double> values() const override { return {0.5, 4.095}; }

    bool plugIn() override
    {
        m_tree.write(m_folder + "name", "ads1015\n");
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

/// A converter of the class IIO that sends scans of its only channel.
class SysfsBufferDevice : public TestDevice
{
public:
    ~SysfsBufferDevice() override { closeNode(); }

    QString kind() const override { return QStringLiteral("sysfs"); }
    QByteArray keys() const override { return "root = fake:scans\ndevice = iio:ads8688\nbuffer = yes\n"; }
    QString name() const override { return QStringLiteral("iio:ads8688"); }
    QStringList inputs() const override { return {QStringLiteral("voltage0")}; }
    QVector<double> values() const override { return {0.5, 4.095}; }

    bool plugIn() override
    {
        for (const auto &[file, text] : {std::pair{"name", "ads8688\n"},
                                         {"in_voltage_scale", "0.5\n"},
                                         {"scan_elements/in_voltage0_en", "0\n"},
                                         {"scan_elements/in_voltage0_index", "0\n"},
                                         {"scan_elements/in_voltage0_type", "le:u16/16>>0\n"},
                                         {"buffer/length", "2\n"},
                                         {"buffer/enable", "0\n"}})
            m_tree.write(QStringLiteral("bus/iio/devices/iio:device0/") + file, text);
        const QString node = m_tree.path(QStringLiteral("dev/iio:device0"));
        const QByteArray path = node.toLocal8Bit();
        QDir().mkpath(QFileInfo(node).path());
        ::mkfifo(path.constData(), 0600);  // it may be there
        closeNode();
        m_writer = ::open(path.constData(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        return m_writer >= 0;
    }
    bool unplug() override
    {
        closeNode();
        return m_tree.remove();
    }
    bool fallSilent() override
    {
        closeNode();
        return true;
    }
    void live() override
    {
        const auto number = quint16(qRound(m_value * 2000.0));
        const quint8 scan[] = {quint8(number), quint8(number >> 8)};
        if (m_writer >= 0 && ::write(m_writer, scan, sizeof scan) < 0)
            qWarning("nothing reads the scans");
    }
    void give(const QString &, double value) override { m_value = value; }

private:
    void closeNode()
    {
        if (m_writer >= 0)
            ::close(m_writer);
        m_writer = -1;
    }

    const SysfsTree m_tree{QStringLiteral("fake:scans")};
    int m_writer = -1;
    double m_value = 0.0;
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

/// A chip with a driver of the kernel, at a bus of the module i2c-stub: its value is the word in
/// register 0, high byte first.
class SysfsKernelDevice : public TestDevice
{
public:
    struct Chip
    {
        QString device;  // "hwmon:lm75"
        QString channel;
        QString driver;   // as the kernel calls it
        QString address;  // "0x48"
        double counts;    // of a unit, in 16 bits
    };
    SysfsKernelDevice(const QString &bus, const Chip &chip)
        : m_bus(bus)
        , m_chip(chip)
    {
    }

    QString kind() const override { return QStringLiteral("sysfs"); }
    QByteArray keys() const override { return "device = " + name().toUtf8() + "\ntimeout = 2 s\n"; }
    QString name() const override { return m_chip.device; }
    QStringList inputs() const override { return {m_chip.channel}; }
    QVector<double> values() const override { return {1.5, -0.5}; }

    bool plugIn() override { return write("new_device", m_chip.driver + QLatin1Char(' ') + m_chip.address); }
    bool unplug() override
    {
        write("delete_device", m_chip.address);  // it may not be there
        return true;
    }
    bool isEverSilent() const override { return false; }
    void give(const QString &, double value) override
    {
        const auto word = quint16(qRound(value * m_chip.counts));
        const quint16 swapped = quint16(word << 8 | word >> 8);
        QProcess::execute(QStringLiteral("i2cset"),
                          {QStringLiteral("-f"), QStringLiteral("-y"), m_bus, m_chip.address, QStringLiteral("0"),
                           QString::number(swapped), QStringLiteral("w")});
    }

private:
    bool write(const char *file, const QString &text) const
    {
        QFile target(QStringLiteral("/sys/bus/i2c/devices/i2c-%1/%2").arg(m_bus, QLatin1String(file)));
        return target.open(QIODevice::WriteOnly | QIODevice::Unbuffered) && target.write(text.toUtf8()) > 0;
    }
    const QString m_bus;
    const Chip m_chip;
};

/// QTPLC_TEST_SYSFS=BUS:ADDRESS:ADDRESS names a bus of the module i2c-stub, and free addresses for
/// a thermometer LM75 and a converter ADS1015: "0:0x48:0x49".
inline void addSysfsDevices(TestDevices *devices)
{
    const QStringList parts = testDeviceParts("QTPLC_TEST_SYSFS");
    if (parts.size() == 3) {
        const SysfsKernelDevice::Chip thermometer{QStringLiteral("hwmon:lm75"), QStringLiteral("temp1"),
                                                  QStringLiteral("lm75"), parts[1], 256.0};
        const SysfsKernelDevice::Chip converter{QStringLiteral("iio:ads1015"), QStringLiteral("voltage0"),
                                                QStringLiteral("ads1015"), parts[2], 16000.0};
        for (const SysfsKernelDevice::Chip &chip : {thermometer, converter})
            devices->insert(QStringLiteral("sysfs, ") + chip.device,
                            [bus = parts[0], chip] { return std::make_unique<SysfsKernelDevice>(bus, chip); });
    }
    devices->insert(QStringLiteral("sysfs, fake converter"), [] { return std::make_unique<SysfsConverterDevice>(); });
    devices->insert(QStringLiteral("sysfs, fake converter with a buffer"),
                    [] { return std::make_unique<SysfsBufferDevice>(); });
    devices->insert(QStringLiteral("sysfs, fake PWM"), [] { return std::make_unique<SysfsPwmDevice>(); });
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/can/CanBus.h"
#include "hardware/can/FakeCanBus.h"

#include <QtCore/QProcess>

/// A drive at a CAN bus that sends its speed again and again, and takes a set point. At a fake bus,
/// or at an interface of the kernel: QTPLC_TEST_CAN=vcan0. Only root can unplug that (it sets the
/// interface down).
class CanDriveDevice : public TestDevice
{
public:
    explicit CanDriveDevice(const QString &interface)
        : m_name(interface.isEmpty() ? QStringLiteral("fake:conformance") : interface)
        , m_isFake(interface.isEmpty())
    {
    }

    QString kind() const override { return QStringLiteral("can"); }
    QByteArray keys() const override
    {
        return "device = " + name().toUtf8()
            + "\nframe.Status = 0x123, 8 bytes, every 20 ms\nsignal.Status.Speed = 7|16@0- (0.5,0)\n"
              "frame.Command = 0x18FEDFFE, 8 bytes\nsignal.Command.Speed = 8|16@1- (0.5,0)\nsend.Command = on change\n";
    }
    QString name() const override { return m_name; }
    QStringList inputs() const override { return {QStringLiteral("Status.Speed")}; }
    QStringList outputs() const override { return {QStringLiteral("Command.Speed")}; }
    QVector<double> values() const override { return {-7.5, 12.0}; }

    bool plugIn() override
    {
        QString error;
        qplc::CanBus::Options options;
        options.keys = {0x18FEDFFE | 0x80000000U};
        setPlugged(true);
        m_bus = qplc::CanBus::make(m_name, &error);
        m_isTalking = m_bus && m_bus->open(options);
        return m_isTalking;
    }
    bool unplug() override
    {
        m_isTalking = false;
        return setPlugged(false);
    }
    bool fallSilent() override
    {
        m_isTalking = false;
        return true;
    }
    void live() override
    {
        if (!m_isTalking)
            return;
        qplc::CanFrame frame;
        frame.id = 0x123;
        frame.size = 8;
        const int raw = int(m_speed * 2.0);
        frame.data[0] = quint8(raw >> 8);
        frame.data[1] = quint8(raw);
        m_bus->send(&frame, 1);
    }
    void give(const QString &, double value) override { m_speed = value; }
    std::optional<double> taken(const QString &) override
    {
        qplc::CanFrame frame;
        while (m_bus && m_bus->receive(&frame, 1) == 1) {
            if (frame.key() == (0x18FEDFFE | 0x80000000U))
                m_taken = double(qint16(quint16(frame.data[1] | frame.data[2] << 8))) * 0.5;
        }
        return m_taken;
    }

private:
    bool setPlugged(bool isPlugged) const
    {
        if (m_isFake)
            return qplc::FakeCanBus::setPlugged(m_name.section(QLatin1Char(':'), 1), isPlugged);
        const QStringList arguments{QStringLiteral("link"), QStringLiteral("set"), m_name,
                                    isPlugged ? QStringLiteral("up") : QStringLiteral("down")};
        return QProcess::execute(QStringLiteral("ip"), arguments) == 0;
    }

    const QString m_name;
    const bool m_isFake;
    std::unique_ptr<qplc::CanBus> m_bus;
    bool m_isTalking = false;
    double m_speed = 0.0;
    std::optional<double> m_taken;
};

inline void addCanDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("can, fake"), [] { return std::make_unique<CanDriveDevice>(QString()); });
    const QString interface = qEnvironmentVariable("QTPLC_TEST_CAN");
    if (!interface.isEmpty())
        devices->insert(QStringLiteral("can, real interface"),
                        [interface] { return std::make_unique<CanDriveDevice>(interface); });
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/serial/SerialLine.h"
#include "serial/NmeaLines.h"
#include "serial/PseudoTerminal.h"

/// A wind sensor that talks as often as it may. At a pseudo-terminal, or at the other end of a real
/// line: QTPLC_TEST_SERIAL=NEAR:FAR, two ports that are tied together
/// ("/dev/ttyUSB0:/dev/ttyUSB1").
class WindSensorDevice : public TestDevice
{
public:
    explicit WindSensorDevice(const QStringList &parts)
        : m_parts(parts)
    {
    }

    QString kind() const override { return QStringLiteral("nmea-wind"); }
    QByteArray keys() const override { return "device = " + name().toUtf8() + "\nbaud = 9600\n"; }
    QString name() const override { return m_parts.value(0, QStringLiteral("fake:wind")); }
    QStringList inputs() const override { return {QStringLiteral("relativeSpeed")}; }
    QVector<double> values() const override { return {7.5, 12.0}; }

    bool plugIn() override
    {
        QString error;
        qplc::SerialSettings settings;
        settings.baud = 9600;
        m_isTalking
            = m_parts.isEmpty() ? m_pseudo.plugIn(name()) : m_far.isOpen() || m_far.open(m_parts[1], settings, &error);
        return m_isTalking;
    }
    bool isPluggable() const override { return m_parts.isEmpty(); }
    bool unplug() override
    {
        m_isTalking = false;
        m_pseudo.unplug();
        return isPluggable();
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
        const QByteArray line = nmeaLine("WIMWV,45,R," + QByteArray::number(m_speed) + ",M,A");
        if (m_parts.isEmpty())
            m_pseudo.send(line);
        else
            m_far.write(line.constData(), line.size());
    }
    void give(const QString &, double value) override { m_speed = value; }

private:
    const QStringList m_parts;
    PseudoTerminal m_pseudo;
    qplc::SerialLine m_far;
    bool m_isTalking = false;
    double m_speed = 0.0;
};

/// An instrument at a pseudo-terminal that sends its only value as often as it may.
class TalkingDevice : public TestDevice
{
public:
    bool plugIn() override
    {
        m_isTalking = m_pseudo.plugIn(name());
        return m_isTalking;
    }
    bool unplug() override
    {
        m_isTalking = false;
        m_pseudo.unplug();
        return true;
    }
    bool fallSilent() override
    {
        m_isTalking = false;
        return true;
    }
    void live() override
    {
        if (m_isTalking)
            m_pseudo.send(lineOf(m_value));
    }
    void give(const QString &, double value) override { m_value = value; }

protected:
    virtual QByteArray lineOf(double value) const = 0;

private:
    PseudoTerminal m_pseudo;
    bool m_isTalking = false;
    double m_value = 0.0;
};

/// A receiver for satellite navigation that rises.
class GnssReceiverDevice : public TalkingDevice
{
public:
    QString kind() const override { return QStringLiteral("nmea-gnss"); }
    QByteArray keys() const override { return "device = fake:gnss\n"; }
    QString name() const override { return QStringLiteral("fake:gnss"); }
    QStringList inputs() const override { return {QStringLiteral("altitude")}; }
    QVector<double> values() const override { return {-3.5, 545.25}; }

protected:
    QByteArray lineOf(double altitude) const override
    {
        return nmeaLine("GPGGA,120000,4807.038,N,01131.000,E,1,08,0.9," + QByteArray::number(altitude) + ",M,46.9,M,,");
    }
};

/// A scale that sends its weight.
class ScaleDevice : public TalkingDevice
{
public:
    QString kind() const override { return QStringLiteral("serial-lines"); }
    QByteArray keys() const override { return "device = fake:scale\npattern = ^(?<weight>[-+.0-9]+) kg$\n"; }
    QString name() const override { return QStringLiteral("fake:scale"); }
    QStringList inputs() const override { return {QStringLiteral("weight")}; }
    QVector<double> values() const override { return {-3.5, 12.25}; }

protected:
    QByteArray lineOf(double weight) const override { return QByteArray::number(weight) + " kg\r\n"; }
};

inline void addSerialDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("nmea-wind, fake"),
                    [] { return std::make_unique<WindSensorDevice>(QStringList()); });
    devices->insert(QStringLiteral("nmea-gnss, fake"), [] { return std::make_unique<GnssReceiverDevice>(); });
    devices->insert(QStringLiteral("serial-lines, fake"), [] { return std::make_unique<ScaleDevice>(); });
    const QStringList parts = testDeviceParts("QTPLC_TEST_SERIAL");
    if (parts.size() == 2)
        devices->insert(QStringLiteral("nmea-wind, real line"),
                        [parts] { return std::make_unique<WindSensorDevice>(parts); });
}

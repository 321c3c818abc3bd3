// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/spi/FakeMcp3208.h"

/// A converter with a voltage at its input 3.
class FakeMcp3208Device : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("mcp3208"); }
    QByteArray keys() const override { return "device = fake:adc\nreference = 4.096\n"; }
    QString name() const override { return QStringLiteral("fake:adc"); }
    QStringList inputs() const override { return {QStringLiteral("voltage3")}; }
    QVector<double> values() const override { return {0.5, 4.095}; }

    bool plugIn() override
    {
        QString error;
        const bool isThere = m_memory.create(name(), qplc::FakeMcp3208::Size, &error);
        if (isThere)
            m_memory.at(qplc::FakeMcp3208::Power) = 1;
        return isThere;
    }
    bool canBeUnplugged() const override { return true; }
    void unplug() override { qplc::FakeMemory::remove(name()); }
    bool canFallSilent() const override { return true; }
    void fallSilent() override { m_memory.at(qplc::FakeMcp3208::Power) = 0; }
    void give(const QString &, double value) override
    {
        const int counts = qRound(value * 1000.0);
        m_memory.at(qplc::FakeMcp3208::Inputs + 6) = quint8(counts & 0xff);
        m_memory.at(qplc::FakeMcp3208::Inputs + 7) = quint8(counts >> 8);
    }

private:
    qplc::FakeMemory m_memory;
};

inline void addSpiDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("mcp3208, fake"), [] { return std::make_unique<FakeMcp3208Device>(); });
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/spi/FakeMcp3208.h"
#include "hardware/spi/FakeSpiRegisters.h"

#include <QtCore/QFile>

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
    bool unplug() override
    {
        qplc::FakeMemory::remove(name());
        return true;
    }
    bool fallSilent() override
    {
        m_memory.at(qplc::FakeMcp3208::Power) = 0;
        return true;
    }
    void give(const QString &, double value) override
    {
        const int counts = qRound(value * 1000.0);
        m_memory.at(qplc::FakeMcp3208::Inputs + 6) = quint8(counts & 0xff);
        m_memory.at(qplc::FakeMcp3208::Inputs + 7) = quint8(counts >> 8);
    }

private:
    qplc::FakeMemory m_memory;
};

/// A device with a value in a register, and one for a set point.
class FakeSpiRegistersDevice : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("spi-registers"); }
    QByteArray keys() const override
    {
        return "device = fake:chip\nidentity = 0x0f 0x33\nregister.in = 0x10, int16, factor 0.5\n"
               "register.out = 0x20, int16, factor 0.5, write\n";
    }
    QString name() const override { return QStringLiteral("fake:chip"); }
    QStringList inputs() const override { return {QStringLiteral("in")}; }
    QStringList outputs() const override { return {QStringLiteral("out")}; }
    QVector<double> values() const override { return {-3.0, 1200.5}; }

    bool plugIn() override
    {
        QString error;
        if (!m_memory.create(name(), qplc::FakeSpiRegisters::Size, &error))
            return false;
        m_memory.at(qplc::FakeSpiRegisters::Power) = 1;
        m_memory.at(qplc::FakeSpiRegisters::ReadBit) = 0x80;
        m_memory.at(qplc::FakeSpiRegisters::CommandSize) = 1;
        at(0x0f) = 0x33;
        at(0x20) = 0x80;  // untouched
        return true;
    }
    bool unplug() override
    {
        qplc::FakeMemory::remove(name());
        return true;
    }
    bool fallSilent() override
    {
        m_memory.at(qplc::FakeSpiRegisters::Power) = 0;
        return true;
    }
    void give(const QString &, double value) override
    {
        const int counts = qRound(value * 2.0);
        at(0x10) = quint8(counts >> 8);
        at(0x11) = quint8(counts);
    }
    std::optional<double> taken(const QString &) override
    {
        const auto counts = qint16(quint16(at(0x20).load() << 8 | at(0x21).load()));
        return counts == std::numeric_limits<qint16>::min() ? std::nullopt : std::optional<double>(0.5 * counts);
    }

private:
    std::atomic<quint8> &at(std::size_t reg) const { return m_memory.at(qplc::FakeSpiRegisters::FirstRegister + reg); }
    qplc::FakeMemory m_memory;
};

/// An SPI bus of the kernel whose chip answers what a file says, numbers of bytes with commas
/// between them: QTPLC_TEST_SPI=DEVICE:FILE,
/// `/dev/spidev0.0:/sys/module/spi_loop/parameters/answer` with the module of tests/vm. What the
/// driver asks is not looked at.
class AnsweringSpiDevice : public TestDevice
{
public:
    explicit AnsweringSpiDevice(const QStringList &parts)
        : m_parts(parts)
    {
    }

    QString kind() const override { return QStringLiteral("mcp3208"); }
    QByteArray keys() const override { return "device = " + name().toUtf8() + "\nreference = 4.096\n"; }
    QString name() const override { return m_parts[0]; }
    QStringList inputs() const override { return {QStringLiteral("voltage3")}; }
    QVector<double> values() const override { return {0.5, 4.095}; }

    bool plugIn() override { return QFile::exists(m_parts[0]) && answer("255,224,0"); }
    bool isPluggable() const override { return false; }
    bool fallSilent() override { return answer("255,255,255"); }
    void give(const QString &, double value) override
    {
        const int counts = qRound(value * 1000.0);
        if (!answer("255," + QByteArray::number(0xe0 | counts >> 8) + "," + QByteArray::number(counts & 0xff)))
            qFatal("cannot write %s", qPrintable(m_parts[1]));
    }

private:
    bool answer(const QByteArray &bytes)
    {
        QFile file(m_parts[1]);
        return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
    }
    const QStringList m_parts;
};

inline void addSpiDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("mcp3208, fake"), [] { return std::make_unique<FakeMcp3208Device>(); });
    devices->insert(QStringLiteral("spi-registers, fake"), [] { return std::make_unique<FakeSpiRegistersDevice>(); });
    const QStringList parts = testDeviceParts("QTPLC_TEST_SPI");
    if (parts.size() == 2)
        devices->insert(QStringLiteral("mcp3208, spidev"),
                        [parts] { return std::make_unique<AnsweringSpiDevice>(parts); });
}

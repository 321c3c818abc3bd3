// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/modbus/FakeModbusDevice.h"
#if defined(QTPLC_TEST_MODBUS)
#include "modbus/ModbusServer.h"
#endif

/// A drive with a register that is read and one that is written.
class ModbusTestDevice : public TestDevice
{
public:
    QString kind() const override { return QStringLiteral("modbus"); }
    QByteArray keys() const override
    {
        return "device = " + name().toUtf8()
            + "\nresponse-timeout = 2 s\nregister.in = input 1, int16, factor 0.5\n"
              "register.out = holding 2, int16, factor 0.5\n";
    }
    QStringList inputs() const override { return {QStringLiteral("in")}; }
    QStringList outputs() const override { return {QStringLiteral("out")}; }
    QVector<double> values() const override { return {-3.0, 1200.5}; }

protected:
    static constexpr quint16 Untouched = 0x8000;
    static quint16 word(double value) { return quint16(qRound(value / 0.5)); }
    static std::optional<double> value(quint16 word)
    {
        return word == Untouched ? std::nullopt : std::optional<double>(0.5 * qint16(word));
    }
};

class FakeModbusTestDevice : public ModbusTestDevice
{
public:
    QString name() const override { return QStringLiteral("fake:drive"); }
    bool plugIn() override
    {
        m_device->set(qplc::ModbusRegister::Holding, 2, {Untouched});
        m_device->setPresent(true);
        return true;
    }
    bool unplug() override
    {
        m_device->setPresent(false);
        return true;
    }
    bool fallSilent() override { return unplug(); }
    void give(const QString &, double value) override { m_device->set(qplc::ModbusRegister::Input, 1, {word(value)}); }
    std::optional<double> taken(const QString &) override
    {
        return value(m_device->values(qplc::ModbusRegister::Holding, 2, 1).front());
    }

private:
    const std::shared_ptr<qplc::FakeModbusDevice> m_device = qplc::FakeModbusDevice::named(QStringLiteral("drive"));
};

#if defined(QTPLC_TEST_MODBUS)
/// A server of libmodbus on loopback.
class ModbusServerDevice : public ModbusTestDevice
{
public:
    QString name() const override { return QStringLiteral("tcp:127.0.0.1:%1").arg(m_port); }
    bool plugIn() override
    {
        m_server.reset();
        m_server = ModbusServer::onTcp(m_port);
        m_server->with([](modbus_mapping_t &values) { values.tab_registers[2] = Untouched; });
        return true;
    }
    bool unplug() override
    {
        m_server.reset();
        return true;
    }
    bool isEverSilent() const override { return false; }
    void give(const QString &, double value) override
    {
        m_server->with([&](modbus_mapping_t &values) { values.tab_input_registers[1] = word(value); });
    }
    std::optional<double> taken(const QString &) override
    {
        return value(m_server->with([](modbus_mapping_t &values) { return values.tab_registers[2]; }));
    }

private:
    const int m_port = ModbusServer::onTcp()->port();  // free now, and hardly taken by another
    std::unique_ptr<ModbusServer> m_server;
};
#endif

inline void addModbusDevices(TestDevices *devices)
{
    devices->insert(QStringLiteral("modbus, fake"), [] { return std::make_unique<FakeModbusTestDevice>(); });
#if defined(QTPLC_TEST_MODBUS)
    devices->insert(QStringLiteral("modbus, TCP"), [] { return std::make_unique<ModbusServerDevice>(); });
#endif
}

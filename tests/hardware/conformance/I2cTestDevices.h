// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TestDevice.h"
#include "hardware/i2c/FakeI2cBus.h"

/// The registers of a device, from its inside.
class I2cTestRegisters
{
public:
    /// \param parts bus and address of a device of the module i2c-stub of the kernel; none: a fake
    ///         bus
    explicit I2cTestRegisters(const QStringList &parts)
        : m_bus(parts.value(0, QStringLiteral("fake:bus")))
        , m_address(parts.value(1, QStringLiteral("0x68")).toInt(nullptr, 0))
    {
    }

    QString bus() const { return m_bus; }
    QByteArray keys() const { return QStringLiteral("device = %1\naddress = %2\n").arg(m_bus).arg(m_address).toUtf8(); }
    /// It can be unplugged and fall silent; the stub of the kernel cannot.
    bool isFake() const { return qplc::FakeMemory::isFake(m_bus); }

    bool plugIn()
    {
        QString error;
        if (isFake() && !m_memory.create(m_bus, qplc::FakeI2cBus::Size, &error))
            return false;
        if (isFake())
            m_memory.at(std::size_t(m_address)) = 1;
        m_device = qplc::I2cBus::open(m_bus, m_address, &error);
        return bool(m_device);
    }
    bool unplug()
    {
        qplc::FakeMemory::remove(m_bus);
        return isFake();
    }
    bool fallSilent()
    {
        if (isFake())
            m_memory.at(std::size_t(m_address)) = 0;
        return isFake();
    }
    void set(quint8 first, const QByteArray &bytes)
    {
        m_device->write(first, reinterpret_cast<const quint8 *>(bytes.constData()), bytes.size());
    }
    QByteArray get(quint8 first, int count)
    {
        QByteArray bytes(count, '\0');
        m_device->read(first, reinterpret_cast<quint8 *>(bytes.data()), count);
        return bytes;
    }

private:
    const QString m_bus;
    const int m_address;
    qplc::FakeMemory m_memory;
    std::unique_ptr<qplc::I2cBus> m_device;
};

inline QByteArray i2cTestWord(double counts)
{
    const auto word = qint16(counts);
    return QByteArray(1, char(word >> 8)) + char(word & 0xff);
}

/// A device with a register that is read and one that is written.
class I2cRegistersDevice : public TestDevice
{
public:
    explicit I2cRegistersDevice(const QStringList &parts)
        : m_registers(parts)
    {
    }

    QString kind() const override { return QStringLiteral("i2c-registers"); }
    QByteArray keys() const override
    {
        return m_registers.keys()
            + "register.in = 0x10, int16, factor 0.5\nregister.out = 0x20, int16, factor 0.5, write\n";
    }
    QString name() const override { return m_registers.bus(); }
    QStringList inputs() const override { return {QStringLiteral("in")}; }
    QStringList outputs() const override { return {QStringLiteral("out")}; }
    QVector<double> values() const override { return {-3.0, 1200.5}; }

    bool plugIn() override
    {
        const bool isThere = m_registers.plugIn();
        if (isThere)
            m_registers.set(0x20, Untouched);
        return isThere;
    }
    bool isPluggable() const override { return m_registers.isFake(); }
    bool unplug() override { return m_registers.unplug(); }
    bool isEverSilent() const override { return m_registers.isFake(); }
    bool fallSilent() override { return m_registers.fallSilent(); }
    void give(const QString &, double value) override { m_registers.set(0x10, i2cTestWord(value / 0.5)); }
    std::optional<double> taken(const QString &) override
    {
        const QByteArray bytes = m_registers.get(0x20, 2);
        if (bytes == Untouched)
            return std::nullopt;
        return 0.5 * qint16(quint16(quint8(bytes[0]) << 8 | quint8(bytes[1])));
    }

private:
    const QByteArray Untouched = QByteArray::fromHex("8000");
    I2cTestRegisters m_registers;
};

/// An inertial sensor that lies still, or is shaken.
class Mpu6050Device : public TestDevice
{
public:
    explicit Mpu6050Device(const QStringList &parts)
        : m_registers(parts)
    {
    }

    QString kind() const override { return QStringLiteral("mpu6050"); }
    QByteArray keys() const override { return m_registers.keys() + "accelerationRange = 4 g\n"; }
    QString name() const override { return m_registers.bus(); }
    QStringList inputs() const override { return {QStringLiteral("accelerationX"), QStringLiteral("accelerationZ")}; }
    QVector<double> values() const override { return {9.80665, -4.903325}; }

    bool plugIn() override
    {
        m_isTalking = m_registers.plugIn();
        if (m_isTalking)
            m_registers.set(0x75, "\x68");
        return m_isTalking;
    }
    bool isPluggable() const override { return m_registers.isFake(); }
    bool unplug() override { return m_registers.unplug(); }
    bool fallSilent() override
    {
        m_isTalking = false;
        m_registers.set(0x3a, QByteArray(1, '\0'));
        return true;
    }
    void live() override
    {
        if (m_isTalking)
            m_registers.set(0x3a, "\x01");
    }
    void give(const QString &input, double value) override
    {
        m_registers.set(input == QLatin1String("accelerationX") ? 0x3b : 0x3f, i2cTestWord(value / 9.80665 * 8192));
    }

private:
    I2cTestRegisters m_registers;
    bool m_isTalking = false;
};

/// QTPLC_TEST_I2C=BUS:ADDRESS names a device of the module i2c-stub (chip_addr=ADDRESS):
/// "/dev/i2c-0:0x68". Its registers are written: nothing else may be there.
inline void addI2cDevices(TestDevices *devices)
{
    QMap<QString, QStringList> rows{{QStringLiteral("fake"), {}}};
    const QStringList stub = testDeviceParts("QTPLC_TEST_I2C");
    if (stub.size() == 2)
        rows.insert(QStringLiteral("i2c-stub"), stub);
    for (auto row = rows.cbegin(); row != rows.cend(); ++row) {
        const QStringList parts = row.value();
        devices->insert(QStringLiteral("i2c-registers, ") + row.key(),
                        [parts] { return std::make_unique<I2cRegistersDevice>(parts); });
        devices->insert(QStringLiteral("mpu6050, ") + row.key(),
                        [parts] { return std::make_unique<Mpu6050Device>(parts); });
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "DriverCatalog.h"

#include "Drivers.h"

namespace qplc {

DriverCatalog &DriverCatalog::instance()
{
    static DriverCatalog catalog;
    return catalog;
}

/// A line for each kind of this library.
DriverCatalog::DriverCatalog()
{
    add(QStringLiteral("can"),
        {QStringLiteral("messages of a CAN bus: SocketCAN, Qt Serial Bus, or a fake bus of this computer"),
         createCanDriver});
    add(QStringLiteral("canopen"),
        {QStringLiteral("a device on a CANopen bus, drives with the profile CiA 402 among them"), createCanOpenDriver});
    add(QStringLiteral("canopen-device"),
        {QStringLiteral("plays a device on a CANopen bus, for a master at the other end"), createCanOpenDeviceDriver});
    add(QStringLiteral("gpio"), {QStringLiteral("switches and lamps at the lines of a GPIO chip"), createGpioDriver});
    add(QStringLiteral("gpio-expander"),
        {QStringLiteral("the same at a chip behind a slow bus (I2C, SPI), beside the cycle"),
         createGpioExpanderDriver});
    add(QStringLiteral("i2c-registers"),
        {QStringLiteral("any I2C device, its registers named by the configuration"), createI2cRegistersDriver});
    add(QStringLiteral("mcp3208"), {QStringLiteral("converter MCP3208 on SPI: 8 voltages"), createMcp3208Driver});
    add(QStringLiteral("modbus"),
        {QStringLiteral("registers and coils of a Modbus device, over TCP or a serial line (RTU)"),
         createModbusDriver});
    add(QStringLiteral("mpu6050"), {QStringLiteral("inertial sensor MPU-6050 on I2C"), createMpu6050Driver});
    add(QStringLiteral("nmea-gnss"),
        {QStringLiteral("receiver for satellite navigation on a serial line that speaks NMEA 0183"),
         createNmeaGnssDriver});
    add(QStringLiteral("nmea-wind"),
        {QStringLiteral("wind sensor on a serial line that speaks NMEA 0183"), createNmeaWindDriver});
    add(QStringLiteral("serial-lines"),
        {QStringLiteral("any instrument on a serial line that sends lines of text with numbers"),
         createSerialLinesDriver});
    add(QStringLiteral("spi-registers"),
        {QStringLiteral("any SPI device, its registers named by the configuration"), createSpiRegistersDriver});
    add(QStringLiteral("sysfs"),
        {QStringLiteral("what the kernel has a driver for: IIO, hwmon, counters, 1-wire thermometers, PWM"),
         createSysfsDriver});
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "DriverCatalog.h"

#include "gpio/GpioDriver.h"
#include "i2c/I2cRegistersDriver.h"
#include "i2c/Mpu6050Driver.h"
#include "modbus/ModbusDriver.h"
#include "serial/NmeaWindDriver.h"
#include "spi/Mcp3208Driver.h"

namespace qplc {

DriverCatalog &DriverCatalog::instance()
{
    static DriverCatalog catalog;
    return catalog;
}

/// A line for each kind of this library.
DriverCatalog::DriverCatalog()
{
    add(QStringLiteral("gpio"), {QStringLiteral("switches and lamps at the lines of a GPIO chip"), [] {
                                     return std::make_unique<GpioDriver>();
                                 }});
    add(QStringLiteral("i2c-registers"),
        {QStringLiteral("any I2C device, its registers named by the configuration"),
         [] { return std::make_unique<I2cRegistersDriver>(); }});
    add(QStringLiteral("mcp3208"),
        {QStringLiteral("converter MCP3208 on SPI: 8 voltages"), [] { return std::make_unique<Mcp3208Driver>(); }});
    add(QStringLiteral("modbus"), {ModbusDriver::description(), [] { return std::make_unique<ModbusDriver>(); }});
    add(QStringLiteral("mpu6050"),
        {QStringLiteral("inertial sensor MPU-6050 on I2C"), [] { return std::make_unique<Mpu6050Driver>(); }});
    add(QStringLiteral("nmea-wind"), {QStringLiteral("wind sensor on a serial line that speaks NMEA 0183"), [] {
                                          return std::make_unique<NmeaWindDriver>();
                                      }});
}

}  // namespace qplc

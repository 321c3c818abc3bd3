// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"

#include <memory>

namespace qplc {

// The drivers of this library, each in the file of its name. What they do is in docs/hardware, and
// above their classes.
std::unique_ptr<QPlcDriver> createCanDriver();
std::unique_ptr<QPlcDriver> createCanOpenDeviceDriver();
std::unique_ptr<QPlcDriver> createCanOpenDriver();
std::unique_ptr<QPlcDriver> createGpioDriver();
std::unique_ptr<QPlcDriver> createGpioExpanderDriver();
std::unique_ptr<QPlcDriver> createI2cRegistersDriver();
std::unique_ptr<QPlcDriver> createMcp3208Driver();
std::unique_ptr<QPlcDriver> createModbusDriver();
std::unique_ptr<QPlcDriver> createMpu6050Driver();
std::unique_ptr<QPlcDriver> createNmeaGnssDriver();
std::unique_ptr<QPlcDriver> createNmeaWindDriver();
std::unique_ptr<QPlcDriver> createSerialLinesDriver();
std::unique_ptr<QPlcDriver> createSpiRegistersDriver();
std::unique_ptr<QPlcDriver> createSysfsDriver();

}  // namespace qplc

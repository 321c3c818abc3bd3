// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusLink.h"
#include "hardware/serial/SerialMode.h"

#include <chrono>
#include <memory>

namespace qplc {

struct ModbusSerialLine
{
    QString device;
    int baud = 19200;
    char parity = 'E';  // or 'N', 'O'
    int stopBits = 1;
    SerialMode mode;
};

/// Requests over TCP or over a serial line, by libmodbus.
/// \param host  name or address of IPv4 or IPv6
std::unique_ptr<ModbusLink> createLibModbusLink(const QString &host, quint16 port,
                                                std::chrono::nanoseconds responseTimeout);
std::unique_ptr<ModbusLink> createLibModbusLink(const ModbusSerialLine &line, std::chrono::nanoseconds responseTimeout);

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusLink.h"

#include <chrono>
#include <memory>
#include <vector>

struct _modbus;

namespace qplc {

/// Requests over TCP or over a serial line, by libmodbus.
class LibModbusLink final : public ModbusLink
{
public:
    struct SerialLine
    {
        QString device;
        int baud = 19200;
        char parity = 'E';  // or 'N', 'O'
        int stopBits = 1;
    };

    /// \param host  name or address of IPv4 or IPv6
    LibModbusLink(const QString &host, quint16 port, std::chrono::nanoseconds responseTimeout);
    LibModbusLink(const SerialLine &line, std::chrono::nanoseconds responseTimeout);
    ~LibModbusLink() override;

    bool open() override;
    void close() override;
    bool read(const ModbusRequest &request, quint16 *values) override;
    bool write(const ModbusRequest &request, const quint16 *values) override;

private:
    struct Release
    {
        void operator()(_modbus *context) const;
    };
    bool isAlone();
    bool select(quint8 unit);
    bool failWithErrno();
    QString remedy(int errorNumber) const;
    int readBits(const ModbusRequest &request, quint16 *values);
    int writeBits(const ModbusRequest &request, const quint16 *values);

    const bool m_isSerial;
    const std::chrono::nanoseconds m_responseTimeout;
    std::unique_ptr<_modbus, Release> m_context;
    std::vector<quint8> m_bits;  // of a request
};

}  // namespace qplc

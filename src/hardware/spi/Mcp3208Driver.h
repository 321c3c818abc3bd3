// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "SpiBus.h"

#include <memory>

namespace qplc {

/// Kind `mcp3208`: converter MCP3208, 8 voltages with 12 bits, alone or as differences of
/// neighbours. See docs/hardware/spi.md.
class Mcp3208Driver : public QPlcDriver
{
public:
    static constexpr int Inputs = 8;

    Mcp3208Driver();

protected:
    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_bus.reset(); }
    bool read() override;
    QString remedy(int errorNumber) const override;

private:
    bool convert(bool isSingle, int input, QPlcReadChannel *channel);

    QString m_device;
    SpiSettings m_settings;
    double m_reference = 0.0;  // [V]
    std::unique_ptr<SpiBus> m_bus;
    std::unique_ptr<QPlcReadChannel> m_voltages[Inputs];  // against ground [V]
    std::unique_ptr<QPlcReadChannel>
        m_differences[Inputs];  // of an input against its neighbour: 0 - 1, 1 - 0, 2 - 3, ... [V]
};

}  // namespace qplc

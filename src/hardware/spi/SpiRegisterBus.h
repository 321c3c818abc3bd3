// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SpiBus.h"
#include "hardware/RegisterBus.h"

namespace qplc {

/// Registers of a device on an SPI bus: a command with the number of the register and a mark for
/// reading or writing, bytes without a meaning, then the values.
class SpiRegisterBus : public RegisterBus
{
public:
    struct Protocol
    {
        Numbers numbers = EightBits;
        int readMask = 0x80;  // or'ed to the number
        int writeMask = 0;
        int dummyBytes = 0;  // between the command and the values that are read
    };
    static constexpr int MostDummyBytes = 4;

    SpiRegisterBus(std::unique_ptr<SpiBus> bus, const Protocol &protocol)
        : m_bus(std::move(bus))
        , m_protocol(protocol)
    {
    }

    bool read(int first, quint8 *bytes, int count) noexcept override;
    bool write(int first, const quint8 *bytes, int count) noexcept override;

private:
    static constexpr int MostBytes = 2 + MostDummyBytes + MostAtOnce;
    int putCommand(int number, quint8 *bytes) const noexcept;

    const std::unique_ptr<SpiBus> m_bus;
    const Protocol m_protocol;
};

}  // namespace qplc

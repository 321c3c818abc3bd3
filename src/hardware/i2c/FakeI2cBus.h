// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "I2cBus.h"
#include "hardware/fake/FakeMemory.h"

namespace qplc {

/// A device on a bus that is played: see FakeMemory. The file has a byte for each of the 128
/// addresses, 1 where a device answers, and SilentTwice where it does so after two transfers that
/// fail; behind them the 256 registers of address 0, those of
/// address 1, and so on.
class FakeI2cBus : public I2cBus
{
public:
    static constexpr quint8 SilentTwice = 3;
    static constexpr std::size_t Addresses = 128;
    static constexpr std::size_t Registers = 256;
    static constexpr std::size_t Size = Addresses + Addresses * Registers;  // [byte] of the file
    static constexpr std::size_t placeOf(int address, int reg)
    {
        return Addresses + std::size_t(address) * Registers + std::size_t(reg);
    }

    static std::unique_ptr<FakeI2cBus> open(const QString &device, int address, QString *error);

    bool read(int first, quint8 *bytes, int count) noexcept override;
    bool write(int first, const quint8 *bytes, int count) noexcept override;

private:
    bool answers(int first, int count) const noexcept;

    FakeMemory m_memory;
    int m_address = 0;
};

}  // namespace qplc

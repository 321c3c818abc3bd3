// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SpiBus.h"
#include "hardware/fake/FakeMemory.h"

namespace qplc {

/// A fake device with registers: see FakeMemory. It has its own protocol, so that a wrong question
/// gets a wrong answer. Byte 0 of the file is 1 while the device has power; byte 1
/// is the bit of the first byte of a command that marks reading; byte 2 is the number of bytes
/// between command and values; byte 3 is the size of a command (0: it has no registers). From byte
/// FirstRegister on the file has the registers. Without registers it sends those from 0 on, and
/// what it is sent comes into those from PlainOutput on.
class FakeSpiRegisters : public SpiBus
{
public:
    static constexpr std::size_t Power = 0;
    static constexpr std::size_t ReadBit = 1;
    static constexpr std::size_t DummyBytes = 2;
    static constexpr std::size_t CommandSize = 3;
    static constexpr std::size_t FirstRegister = 16;
    static constexpr std::size_t PlainOutput = 0x100;
    static constexpr std::size_t Size = FirstRegister + 0x10000;

    static std::unique_ptr<FakeSpiRegisters> open(const QString &device, QString *error);

    bool transfer(const quint8 *sent, quint8 *received, int count) noexcept override;

private:
    FakeMemory m_memory;
};

}  // namespace qplc

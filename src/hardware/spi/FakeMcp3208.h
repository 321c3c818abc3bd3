// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SpiBus.h"
#include "hardware/fake/FakeMemory.h"

namespace qplc {

/// A converter that is played: see FakeMemory. The first byte of the file is 1 while the chip has
/// power; from byte 2 on the file has the counts of the 8 inputs, 0 ... 4095, 2 bytes each, the low
/// one first.
///
/// It answers bit by bit as the chip does, so that a wrong question gets the wrong answer.
class FakeMcp3208 : public SpiBus
{
public:
    static constexpr std::size_t Power = 0;
    static constexpr std::size_t Inputs = 2;
    static constexpr std::size_t Size = Inputs + 2 * 8;

    static std::unique_ptr<FakeMcp3208> open(const QString &device, QString *error);

    bool transfer(const quint8 *sent, quint8 *received, int count) noexcept override;

private:
    int counts(int input) const noexcept;
    int convert(int command) const noexcept;

    FakeMemory m_memory;
};

}  // namespace qplc

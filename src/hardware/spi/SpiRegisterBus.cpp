// SPDX-License-Identifier: Apache-2.0
#include "SpiRegisterBus.h"

#include <cstring>

namespace qplc {

/// \return its size [byte]
int SpiRegisterBus::putCommand(int number, quint8 *bytes) const noexcept
{
    int size = 0;
    if (m_protocol.numbers == SixteenBits)
        bytes[size++] = quint8(number >> 8);
    bytes[size++] = quint8(number);
    return size;
}

bool SpiRegisterBus::read(int first, quint8 *bytes, int count) noexcept
{
    quint8 sent[MostBytes] = {};
    quint8 received[MostBytes] = {};
    int head = 0;
    if (first != NoRegister)
        head = putCommand(first | m_protocol.readMask, sent) + m_protocol.dummyBytes;
    if (!m_bus->transfer(sent, received, head + count))
        return false;
    std::memcpy(bytes, received + head, std::size_t(count));
    return true;
}

bool SpiRegisterBus::write(int first, const quint8 *bytes, int count) noexcept
{
    quint8 sent[MostBytes] = {};
    quint8 received[MostBytes] = {};
    const int head = first == NoRegister ? 0 : putCommand(first | m_protocol.writeMask, sent);
    std::memcpy(sent + head, bytes, std::size_t(count));
    return m_bus->transfer(sent, received, head + count);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "FakeSpiRegisters.h"

#include <algorithm>
#include <cerrno>

namespace qplc {

std::unique_ptr<FakeSpiRegisters> FakeSpiRegisters::open(const QString &device, QString *error)
{
    auto chip = std::make_unique<FakeSpiRegisters>();
    return chip->m_memory.open(device, Size, error) ? std::move(chip) : nullptr;
}

bool FakeSpiRegisters::transfer(const quint8 *sent, quint8 *received, int count) noexcept
{
    if (!m_memory.isThere()) {
        errno = ENODEV;
        return false;
    }
    std::fill_n(received, count, quint8(0xff));  // without an answer, the pull-up drives the wire
    if (m_memory.at(Power).load() == 0)
        return true;
    const int commandSize = std::min<int>(m_memory.at(CommandSize).load(), 2);
    const quint8 readBit = m_memory.at(ReadBit).load();
    if (count < commandSize)
        return true;
    const bool isRead = commandSize == 0 || (sent[0] & readBit) != 0;
    int place = 0;
    for (int i = 0; i < commandSize; ++i)
        place = place << 8 | (i == 0 ? sent[0] & ~readBit : sent[i]);
    for (int i = commandSize + (isRead ? m_memory.at(DummyBytes).load() : 0); i < count; ++i, ++place) {
        const std::size_t reg = FirstRegister + std::size_t(place & 0xffff);
        if (isRead)
            received[i] = m_memory.at(reg).load();
        if (!isRead)
            m_memory.at(reg).store(sent[i]);
        if (commandSize == 0)
            m_memory.at(reg + PlainOutput).store(sent[i]);
    }
    return true;
}

}  // namespace qplc

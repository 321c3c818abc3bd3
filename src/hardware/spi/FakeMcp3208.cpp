// SPDX-License-Identifier: Apache-2.0
#include "FakeMcp3208.h"

#include <cerrno>

namespace qplc {

std::unique_ptr<FakeMcp3208> FakeMcp3208::open(const QString &device, QString *error)
{
    auto chip = std::make_unique<FakeMcp3208>();
    return chip->m_memory.open(device, Size, error) ? std::move(chip) : nullptr;
}

int FakeMcp3208::counts(int input) const noexcept
{
    const std::size_t place = Inputs + 2 * std::size_t(input);
    return (m_memory.at(place).load() | m_memory.at(place + 1).load() << 8) & 0xfff;
}

/// \param command  the 4 bits behind the start bit: single-ended, input
int FakeMcp3208::convert(int command) const noexcept
{
    const int input = command & 7;
    if (command & 8)
        return counts(input);
    return qMax(0, counts(input) - counts(input ^ 1));
}

bool FakeMcp3208::transfer(const quint8 *sent, quint8 *received, int count) noexcept
{
    if (!m_memory.isThere()) {
        errno = ENODEV;
        return false;
    }
    const bool hasPower = m_memory.at(Power).load() != 0;
    int place = -1;  // bits since the start bit
    int command = 0;
    int result = 0;
    for (int i = 0; i < 8 * count; ++i) {
        const int bit = sent[i / 8] >> (7 - i % 8) & 1;
        int answer = 1;  // nobody drives the wire, and its pull-up does
        if (place >= 0)
            ++place;
        else if (bit)
            place = 0;
        if (place >= 1 && place <= 4)
            command = command << 1 | bit;
        if (place == 5)
            result = convert(command);  // the chip samples
        if (place == 6)
            answer = 0;
        else if (place > 6)
            answer = place > 18 ? 0 : result >> (18 - place) & 1;
        const auto mask = quint8(0x80 >> i % 8);
        received[i / 8] = quint8(hasPower && !answer ? received[i / 8] & ~mask : received[i / 8] | mask);
    }
    return true;
}

}  // namespace qplc

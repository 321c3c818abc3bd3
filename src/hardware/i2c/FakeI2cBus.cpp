// SPDX-License-Identifier: Apache-2.0
#include "FakeI2cBus.h"

#include <algorithm>
#include <cerrno>

namespace qplc {

std::unique_ptr<FakeI2cBus> FakeI2cBus::open(const QString &device, int address, QString *error)
{
    auto bus = std::make_unique<FakeI2cBus>();
    bus->m_address = address;
    return bus->m_memory.open(device, Size, error) ? std::move(bus) : nullptr;
}

bool FakeI2cBus::answers(int first, int count) const noexcept
{
    if (!m_memory.isThere()) {
        errno = ENODEV;
        return false;
    }
    auto &mark = m_memory.at(std::size_t(m_address));
    const quint8 now = mark.load();
    if (now > 1)
        mark.store(quint8(now - 1));
    errno = ENXIO;
    if (now != 1 || placeOf(m_address, first + count) > Size)
        return false;
    m_memory.at(0).fetch_add(1);
    return true;
}

bool FakeI2cBus::read(int first, quint8 *bytes, int count) noexcept
{
    first = std::max(first, 0);
    if (!answers(first, count))
        return false;
    for (int i = 0; i < count; ++i)
        bytes[i] = m_memory.at(placeOf(m_address, first + i)).load();
    return true;
}

bool FakeI2cBus::write(int first, const quint8 *bytes, int count) noexcept
{
    first = std::max(first, 0);
    if (!answers(first, count))
        return false;
    for (int i = 0; i < count; ++i)
        m_memory.at(placeOf(m_address, first + i)).store(bytes[i]);
    return true;
}

}  // namespace qplc

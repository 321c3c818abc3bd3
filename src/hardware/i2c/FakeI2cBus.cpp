// SPDX-License-Identifier: Apache-2.0
#include "FakeI2cBus.h"

#include <cerrno>

namespace qplc {

std::unique_ptr<FakeI2cBus> FakeI2cBus::open(const QString &device, int address, QString *error)
{
    auto bus = std::make_unique<FakeI2cBus>();
    bus->m_address = address;
    return bus->m_memory.open(device, Size, error) ? std::move(bus) : nullptr;
}

bool FakeI2cBus::answers() const noexcept
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
    return now == 1;
}

bool FakeI2cBus::read(quint8 first, quint8 *bytes, int count) noexcept
{
    if (!answers())
        return false;
    for (int i = 0; i < count; ++i)
        bytes[i] = m_memory.at(placeOf(m_address, quint8(first + i))).load();
    return true;
}

bool FakeI2cBus::write(quint8 first, const quint8 *bytes, int count) noexcept
{
    if (!answers())
        return false;
    for (int i = 0; i < count; ++i)
        m_memory.at(placeOf(m_address, quint8(first + i))).store(bytes[i]);
    return true;
}

}  // namespace qplc

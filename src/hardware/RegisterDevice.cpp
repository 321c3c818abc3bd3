// SPDX-License-Identifier: Apache-2.0
#include "RegisterDevice.h"

namespace qplc {

bool RegisterDevice::open(std::unique_ptr<RegisterBus> bus)
{
    reset();
    m_bus = std::move(bus);
    return bool(m_bus);
}

bool RegisterDevice::read(int first, quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->read(first, bytes, count); });
}

bool RegisterDevice::write(int first, const quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->write(first, bytes, count); });
}

}  // namespace qplc

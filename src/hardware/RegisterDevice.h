// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DeviceAccess.h"
#include "RegisterBus.h"

#include <memory>

namespace qplc {

/// A device with registers at a bus: each transfer is an access that is repeated and counted.
class RegisterDevice : public DeviceAccess
{
public:
    using DeviceAccess::DeviceAccess;

    /// \param bus  null if it could not be opened \return whether there is a bus
    bool open(std::unique_ptr<RegisterBus> bus);
    void close() { m_bus.reset(); }

    /// \return false, with errno
    bool read(int first, quint8 *bytes, int count) noexcept;
    bool write(int first, const quint8 *bytes, int count) noexcept;

private:
    std::unique_ptr<RegisterBus> m_bus;
};

}  // namespace qplc

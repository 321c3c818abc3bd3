// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DeviceHealth.h"
#include "QPlcReadChannel.h"
#include "RegisterBus.h"

#include <memory>

class QPlcDriverSettings;

namespace qplc {

/// A device at a bus, as a driver uses it: a transfer that fails is repeated (key `retries`) and
/// counted (channel `@errors`), and the values of the device are held until it is lost.
///
/// The driver calls begin() in its write(), keep() after a transfer that failed, and succeed() at
/// the end of its read(). No transfer goes out between a failed one and the next begin().
class RegisterDevice
{
public:
    explicit RegisterDevice(QPlcDriver *driver)
        : m_errors(driver, QStringLiteral("@errors"))
    {
    }

    /// Reads the key `retries`.
    void configure(QPlcDriverSettings &settings);
    /// \param bus  null: it could not be opened \return whether it is there
    bool open(std::unique_ptr<RegisterBus> bus);
    void close() { m_bus.reset(); }

    /// \return false, with errno
    bool read(int first, quint8 *bytes, int count) noexcept;
    bool write(int first, const quint8 *bytes, int count) noexcept;

    /// What it has answered is not from this device.
    void reject() noexcept;

    void begin() noexcept { m_hasFailed = false; }
    bool hasFailed() const noexcept { return m_hasFailed; }
    /// After a transfer that failed. \return false when the device is lost
    bool keep(qint64 now, qint64 timeout) noexcept;
    void succeed(qint64 now) noexcept;

private:
    template<typename Transfer>
    bool repeat(Transfer transfer) noexcept;

    std::unique_ptr<RegisterBus> m_bus;
    DeviceHealth m_health;
    QPlcReadChannel m_errors;
    int m_retries = DeviceHealth::DefaultRetries;
    bool m_hasFailed = false;  // in this turn
    int m_errorNumber = 0;
};

}  // namespace qplc

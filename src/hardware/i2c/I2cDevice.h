// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "I2cBus.h"
#include "QPlcReadChannel.h"
#include "hardware/DeviceHealth.h"

class QPlcDriverSettings;

namespace qplc {

/// A device at a bus, as a driver uses it: a transfer that fails is repeated (key `retries`) and
/// counted (channel `@errors`), and the values of the device are held until it is lost.
///
/// The driver calls begin() in its write(), keep() after a transfer that failed, and succeed() at
/// the end of its read(). No transfer goes out between a failed one and the next begin().
class I2cDevice
{
public:
    explicit I2cDevice(QPlcDriver *driver)
        : m_errors(driver, QStringLiteral("@errors"))
    {
    }

    /// Claims the address (key `address`) of the bus \a device.
    void configure(const QString &device, int address, QPlcDriverSettings &settings);
    bool open(const QString &device, int address, QString *error, I2cBus::Numbers numbers = I2cBus::EightBits);
    void close() { m_bus.reset(); }

    /// \return false, with errno
    bool read(int first, quint8 *bytes, int count) noexcept;
    bool write(int first, const quint8 *bytes, int count) noexcept;

    void begin() noexcept { m_hasFailed = false; }
    bool hasFailed() const noexcept { return m_hasFailed; }
    /// After a transfer that failed. \return false when the device is lost
    bool keep(qint64 now, qint64 timeout) noexcept;
    void succeed(qint64 now) noexcept;

private:
    template<typename Transfer>
    bool repeat(Transfer transfer) noexcept;

    std::unique_ptr<I2cBus> m_bus;
    DeviceHealth m_health;
    QPlcReadChannel m_errors;
    int m_retries = DeviceHealth::DefaultRetries;
    bool m_hasFailed = false;  // in this turn
    int m_errorNumber = 0;
};

}  // namespace qplc

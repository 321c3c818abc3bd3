// SPDX-License-Identifier: Apache-2.0
#include "I2cDevice.h"

#include "QPlcDriverSettings.h"

#include <cerrno>

namespace qplc {

void I2cDevice::configure(const QString &device, int address, QPlcDriverSettings &settings)
{
    settings.claim(QStringLiteral("address"),
                   QStringLiteral("address %1 of %2")
                       .arg(i2cAddressText(address), QString(device).remove(QStringLiteral("/dev/"))));
    m_retries
        = int(settings.integer(QStringLiteral("retries"), DeviceHealth::DefaultRetries, 0, DeviceHealth::MostRetries));
}

bool I2cDevice::open(const QString &device, int address, QString *error, I2cBus::Numbers numbers)
{
    m_health.reset();
    m_hasFailed = false;
    m_bus = I2cBus::open(device, address, error, numbers);
    return bool(m_bus);
}

template<typename Transfer>
bool I2cDevice::repeat(Transfer transfer) noexcept
{
    for (int left = m_health.attempts(m_retries); left > 0; --left) {
        if (transfer())
            return true;
        m_errorNumber = errno;
        m_health.countError();
        if (m_errorNumber == ENODEV || m_errorNumber == EOPNOTSUPP)
            break;
    }
    m_hasFailed = true;
    errno = m_errorNumber;
    return false;
}

bool I2cDevice::read(int first, quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->read(first, bytes, count); });
}

bool I2cDevice::write(int first, const quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->write(first, bytes, count); });
}

bool I2cDevice::keep(qint64 now, qint64 timeout) noexcept
{
    m_health.fail(now, timeout);
    m_errors.set(double(m_health.errors()), now);
    return m_errorNumber != ENODEV && !m_health.isLost(now, timeout);  // ENODEV: the adapter is gone
}

void I2cDevice::succeed(qint64 now) noexcept
{
    m_health.succeed(now);
    m_errors.set(double(m_health.errors()), now);
}

}  // namespace qplc

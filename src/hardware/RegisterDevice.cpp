// SPDX-License-Identifier: Apache-2.0
#include "RegisterDevice.h"

#include "QPlcDriverSettings.h"

#include <cerrno>

namespace qplc {

void RegisterDevice::configure(QPlcDriverSettings &settings)
{
    m_retries
        = int(settings.integer(QStringLiteral("retries"), DeviceHealth::DefaultRetries, 0, DeviceHealth::MostRetries));
}

bool RegisterDevice::open(std::unique_ptr<RegisterBus> bus)
{
    m_health.reset();
    m_hasFailed = false;
    m_errorNumber = 0;
    m_bus = std::move(bus);
    return bool(m_bus);
}

template<typename Transfer>
bool RegisterDevice::repeat(Transfer transfer) noexcept
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

bool RegisterDevice::read(int first, quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->read(first, bytes, count); });
}

bool RegisterDevice::write(int first, const quint8 *bytes, int count) noexcept
{
    return repeat([&] { return m_bus->write(first, bytes, count); });
}

void RegisterDevice::reject() noexcept
{
    m_errorNumber = 0;
    m_hasFailed = true;
    m_health.countError();
}

bool RegisterDevice::keep(qint64 now, qint64 timeout) noexcept
{
    m_health.fail(now, timeout);
    m_errors.set(double(m_health.errors()), now);
    return m_errorNumber != ENODEV && !m_health.isLost(now, timeout);  // ENODEV: the adapter is gone
}

void RegisterDevice::succeed(qint64 now) noexcept
{
    m_health.succeed(now);
    m_errors.set(double(m_health.errors()), now);
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "DeviceAccess.h"

#include "QPlcDriverSettings.h"

namespace qplc {

void DeviceAccess::configure(QPlcDriverSettings &settings)
{
    m_retries
        = int(settings.integer(QStringLiteral("retries"), DeviceHealth::DefaultRetries, 0, DeviceHealth::MostRetries));
}

void DeviceAccess::reset() noexcept
{
    m_health.reset();
    m_hasFailed = false;
    m_errorNumber = 0;
}

void DeviceAccess::reject() noexcept
{
    m_errorNumber = 0;
    m_hasFailed = true;
    m_health.countError();
}

bool DeviceAccess::keep(qint64 now, qint64 timeout) noexcept
{
    m_health.fail(now, timeout);
    m_errors.set(double(m_health.errors()), now);
    return !isGone() && !m_health.isLost(now, timeout);
}

void DeviceAccess::succeed(qint64 now) noexcept
{
    m_health.succeed(now);
    m_errors.set(double(m_health.errors()), now);
}

}  // namespace qplc

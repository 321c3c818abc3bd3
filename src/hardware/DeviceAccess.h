// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DeviceHealth.h"
#include "QPlcReadChannel.h"

#include <cerrno>

class QPlcDriverSettings;

namespace qplc {

/// Accesses to a slow device, as a driver makes them: an access that fails is repeated (key
/// `retries`) and counted (channel `@errors`), and the values of the device are held until it is
/// lost.
///
/// The driver calls begin() in its write(), keep() after an access that failed, and succeed() at
/// the end of its read(). It makes no access between a failed one and the next begin().
class DeviceAccess
{
public:
    explicit DeviceAccess(QPlcDriver *driver)
        : m_errors(driver, QStringLiteral("@errors"))
    {
    }

    /// Reads the key `retries`.
    void configure(QPlcDriverSettings &settings);
    /// The device is opened. Counted errors stay.
    void reset() noexcept;

    /// \param access  returns false, with errno, when it has failed \return false, with errno
    template<typename Access>
    bool repeat(Access access);
    /// Counts an answer that came from another device.
    void reject() noexcept;

    void begin() noexcept { m_hasFailed = false; }
    bool hasFailed() const noexcept { return m_hasFailed; }
    /// After an access that failed. \return false when the device is lost
    bool keep(qint64 now, qint64 timeout) noexcept;
    void succeed(qint64 now) noexcept;

private:
    /// The device or its adapter does not exist any more.
    bool isGone() const noexcept { return m_errorNumber == ENODEV || m_errorNumber == ENOENT; }

    DeviceHealth m_health;
    QPlcReadChannel m_errors;
    int m_retries = DeviceHealth::DefaultRetries;
    bool m_hasFailed = false;  // since begin()
    int m_errorNumber = 0;     // of the last access that failed
};

template<typename Access>
bool DeviceAccess::repeat(Access access)
{
    for (int left = m_health.attempts(m_retries); left > 0; --left) {
        if (access())
            return true;
        m_errorNumber = errno;
        m_health.countError();
        if (isGone() || m_errorNumber == EOPNOTSUPP)
            break;
    }
    m_hasFailed = true;
    errno = m_errorNumber;
    return false;
}

}  // namespace qplc

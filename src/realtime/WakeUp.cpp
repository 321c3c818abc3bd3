// SPDX-License-Identifier: Apache-2.0
#include "WakeUp.h"

#include <cerrno>
#include <cstdint>
#include <sys/eventfd.h>
#include <unistd.h>

namespace qplc {

WakeUp::WakeUp()
    : m_descriptor(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))
    , m_error(m_descriptor < 0 ? errno : 0)
{
}

WakeUp::~WakeUp()
{
    if (m_descriptor >= 0)
        close(m_descriptor);
}

QString WakeUp::errorString() const
{
    if (isValid())
        return {};
    return QStringLiteral("wake-up: eventfd() failed: %1; 'ulimit -n' shows how many descriptors a process may have")
        .arg(qt_error_string(m_error));
}

void WakeUp::wake() noexcept
{
    const std::uint64_t once = 1;
    // Fails only when the counter is full (2^64 - 2), and then the descriptor is readable anyway.
    [[maybe_unused]] const ssize_t written = write(m_descriptor, &once, sizeof once);
}

bool WakeUp::consume() noexcept
{
    std::uint64_t times = 0;
    return read(m_descriptor, &times, sizeof times) == ssize_t(sizeof times);
}

}  // namespace qplc

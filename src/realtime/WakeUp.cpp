// SPDX-License-Identifier: Apache-2.0
#include "WakeUp.h"

namespace qplc {

WakeUp::WakeUp()
    : m_host(Host::current())
    , m_descriptor(m_host.openWakeUp(&m_error))
{
}

WakeUp::~WakeUp()
{
    if (m_descriptor >= 0)
        m_host.closeWakeUp(m_descriptor);
}

QString WakeUp::errorString() const
{
    if (isValid())
        return {};
    return QStringLiteral("wake-up: eventfd() failed: %1; 'ulimit -n' shows how many descriptors a process may have")
        .arg(qt_error_string(m_error));
}

bool WakeUp::consume() noexcept
{
    return m_host.consumeWakeUp(m_descriptor);
}

}  // namespace qplc

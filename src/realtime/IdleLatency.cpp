// SPDX-License-Identifier: Apache-2.0
#include "IdleLatency.h"

#include "Remedies.h"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <unistd.h>

namespace qplc {

QPlcRealTimeSetting IdleLatency::limit(int microseconds)
{
    release();
    QPlcRealTimeSetting setting;
    setting.name = QStringLiteral("idle latency");
    setting.wanted = QStringLiteral("at most %1 µs").arg(microseconds);
    const std::int32_t wanted = microseconds;
    m_device = ::open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
    const bool isWritten = m_device >= 0 && ::write(m_device, &wanted, sizeof wanted) == ssize_t(sizeof wanted);
    const int error = isWritten ? 0 : errno;
    std::int32_t obtained = 0;  // the strictest wish of all programs
    const bool isRead = isWritten && ::read(m_device, &obtained, sizeof obtained) == ssize_t(sizeof obtained);
    setting.obtained = isRead ? QStringLiteral("%1 µs").arg(obtained) : QStringLiteral("that of the system");
    setting.granted = isRead && obtained <= wanted;
    if (!setting.granted)
        setting.remedy = idleLatencyRemedy(error);
    return setting;
}

void IdleLatency::release()
{
    if (m_device >= 0)
        ::close(m_device);
    m_device = -1;
}

}  // namespace qplc

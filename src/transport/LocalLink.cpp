// SPDX-License-Identifier: Apache-2.0
#include "LocalLink.h"

#include "PeerFile.h"

namespace qplc {

std::unique_ptr<CyclicLink> LocalLink::open(const LocalPaths &paths, uid_t owner, QString *error)
{
    std::unique_ptr<LocalLink> link(new LocalLink);
    return link->openAll(paths, owner, error) ? std::move(link) : nullptr;
}

bool LocalLink::openAll(const LocalPaths &paths, uid_t owner, QString *error)
{
    PeerFile pipe;
    if (!m_memory.open(paths.channel, QStringLiteral("memory"), sizeof(SharedChannel), owner, error)
        || !m_bell.open(paths.doorbell, QStringLiteral("doorbell"), sizeof(Doorbell), owner, error)
        || !pipe.find(paths.pipe, QStringLiteral("pipe"), owner, error))
        return false;
    m_descriptor = pipe.openPipe(error);
    return m_descriptor >= 0;
}

CyclicLink::Status LocalLink::receive(const char **frame, std::size_t *size) noexcept
{
    if (poll(frame, size) == Received)
        return Received;
    channel()->inputs.wait();
    return poll(frame, size);
}

CyclicLink::Status LocalLink::poll(const char **frame, std::size_t *size) noexcept
{
    *frame = m_frame.data();
    *size = channel()->inputs.pop(m_frame.data(), m_frame.size());
    return *size > 0 ? Received : Nothing;
}

}  // namespace qplc

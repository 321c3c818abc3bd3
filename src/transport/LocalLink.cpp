// SPDX-License-Identifier: Apache-2.0
#include "LocalLink.h"

#include <fcntl.h>
#include <sys/stat.h>

namespace qplc {

namespace {

/// Whether \a descriptor is the end of a pipe on which a write never waits.
bool isBellPipe(int descriptor)
{
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode)
        && (::fcntl(descriptor, F_GETFL) & (O_ACCMODE | O_NONBLOCK)) == (O_WRONLY | O_NONBLOCK);
}

}  // namespace

std::unique_ptr<LocalLink> LocalLink::begin(std::uint64_t session, QString *error)
{
    std::unique_ptr<LocalLink> link(new LocalLink);
    return link->m_connection.open(session, error) ? std::move(link) : nullptr;
}

bool LocalLink::finish(const CycleVolume &volume, QString *error)
{
    enum { Channel, Bell, Pipe, Count };
    std::vector<Descriptor> passed = m_connection.take(Count, error);
    if (passed.empty() || !m_channel.adopt(std::move(passed[Channel]), volume, error)
        || !m_bell.adopt(std::move(passed[Bell]), QStringLiteral("doorbell"), sizeof(Doorbell), error))
        return false;
    if (!isBellPipe(passed[Pipe].number())) {
        *error = QStringLiteral("what the master has passed as pipe is not a pipe to write to without waiting");
        return false;
    }
    m_descriptor = passed[Pipe].release();
    return true;
}

CyclicLink::Status LocalLink::receive(const char **frame, std::size_t *size) noexcept
{
    if (poll(frame, size) == Received)
        return Received;
    m_channel.inputs.wait();
    return poll(frame, size);
}

CyclicLink::Status LocalLink::poll(const char **frame, std::size_t *size) noexcept
{
    *frame = m_frame.data();
    *size = m_channel.inputs.pop(m_frame.data(), m_frame.size());
    return *size > 0 ? Received : Nothing;
}

}  // namespace qplc

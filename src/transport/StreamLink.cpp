// SPDX-License-Identifier: Apache-2.0
#include "StreamLink.h"

#include <cerrno>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>

namespace qplc {

std::unique_ptr<CyclicLink> StreamLink::make(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
{
    // Qt made it non-blocking; the cycle thread wants to wait in recv().
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    const int on = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const timeval longestSend{0, 50'000};
    ::setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &longestSend, sizeof longestSend);
    return std::unique_ptr<CyclicLink>(new StreamLink(descriptor, cutter, largestFrame));
}

StreamLink::StreamLink(int descriptor, const FrameCutter &cutter, std::size_t largestFrame)
    : CyclicLink(descriptor)
    , m_cutter(cutter)
    , m_buffer(4 * largestFrame)
    , m_sender(largestFrame)
{
}

CyclicLink::Status StreamLink::poll(const char **frame, std::size_t *size) noexcept
{
    return read(frame, size, MSG_DONTWAIT);
}

CyclicLink::Status StreamLink::read(const char **frame, std::size_t *size, int flags) noexcept
{
    for (;;) {
        switch (m_buffer.next(m_cutter, frame, size)) {
        case FrameBuffer::Frame:
            return Received;
        case FrameBuffer::Garbage:
            return Closed;
        case FrameBuffer::NeedMore:
            break;
        }
        m_buffer.compact();
        m_sender.sendRest(m_descriptor, MSG_DONTWAIT);
        const ssize_t count = ::recv(m_descriptor, m_buffer.space(), m_buffer.spaceSize(), flags);
        if (count < 0)
            return isTransient(errno) ? Nothing : Closed;
        if (count == 0)
            return Closed;
        m_buffer.filled(std::size_t(count));
    }
}

}  // namespace qplc

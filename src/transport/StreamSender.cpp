// SPDX-License-Identifier: Apache-2.0
#include "StreamSender.h"

#include <cstring>
#include <sys/socket.h>

namespace qplc {

namespace {

ssize_t sendSome(int descriptor, const char *bytes, std::size_t size, int flags) noexcept
{
    return ::send(descriptor, bytes, size, flags | MSG_NOSIGNAL);
}

}  // namespace

StreamSender::StreamSender(std::size_t largestFrame)
    : m_rest(new char[largestFrame]())
    , m_capacity(largestFrame)
{
}

bool StreamSender::sendRest(int descriptor, int flags) noexcept
{
    while (hasRest()) {
        const ssize_t count = sendSome(descriptor, m_rest.get() + m_begin, m_end - m_begin, flags);
        if (count < 0)
            return false;
        m_begin += std::size_t(count);
    }
    m_begin = m_end = 0;
    return true;
}

bool StreamSender::send(int descriptor, const char *frame, std::size_t size, int flags) noexcept
{
    if (size > m_capacity || !sendRest(descriptor, flags))
        return false;
    const ssize_t count = sendSome(descriptor, frame, size, flags);
    if (count < 0)
        return false;
    m_end = size - std::size_t(count);
    std::memcpy(m_rest.get(), frame + count, m_end);
    return true;
}

}  // namespace qplc

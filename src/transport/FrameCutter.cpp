// SPDX-License-Identifier: Apache-2.0
#include "FrameCutter.h"

#include <cstring>

namespace qplc {

FrameBuffer::FrameBuffer(std::size_t capacity)
    : m_bytes(new char[capacity])
    , m_capacity(capacity)
{
}

FrameBuffer::~FrameBuffer()
{
    delete[] m_bytes;
}

FrameBuffer::Result FrameBuffer::next(const FrameCutter &cutter, const char **frame, std::size_t *size) noexcept
{
    const std::size_t available = m_end - m_begin;
    if (available < cutter.headerSize)
        return NeedMore;
    const std::size_t wanted = cutter.frameSize(cutter.context, m_bytes + m_begin);
    if (wanted < cutter.headerSize || wanted > m_capacity)
        return Garbage;
    if (available < wanted)
        return NeedMore;
    *frame = m_bytes + m_begin;
    *size = wanted;
    m_begin += wanted;
    return Frame;
}

void FrameBuffer::compact() noexcept
{
    if (m_begin == 0)
        return;
    std::memmove(m_bytes, m_bytes + m_begin, m_end - m_begin);
    m_end -= m_begin;
    m_begin = 0;
}

}  // namespace qplc

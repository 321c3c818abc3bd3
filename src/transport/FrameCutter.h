// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace qplc {

/// Tells where a frame ends in a byte stream, to links that know nothing of frames.
struct FrameCutter
{
    std::size_t headerSize = 0;  // bytes that frameSize looks at
    std::size_t (*frameSize)(const void *context, const char *header)
        = nullptr;  // whole frame [byte]; 0: no frame begins here
    const void *context = nullptr;
};

/// Collects the bytes of a stream and hands out whole frames. Allocation-free after construction.
class FrameBuffer
{
public:
    explicit FrameBuffer(std::size_t capacity);
    ~FrameBuffer();
    FrameBuffer(const FrameBuffer &) = delete;
    FrameBuffer &operator=(const FrameBuffer &) = delete;

    char *space() { return m_bytes + m_end; }
    std::size_t spaceSize() const { return m_capacity - m_end; }
    void filled(std::size_t size) { m_end += size; }

    enum Result { Frame, NeedMore, Garbage };
    /// The next whole frame; it stays valid until the next call of compact().
    Result next(const FrameCutter &cutter, const char **frame, std::size_t *size) noexcept;
    /// Moves the rest to the begin, to make space.
    void compact() noexcept;

private:
    char *m_bytes;
    std::size_t m_capacity;
    std::size_t m_begin = 0;
    std::size_t m_end = 0;
};

}  // namespace qplc

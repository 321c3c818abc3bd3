// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "FrameCutter.h"
#include "StreamSender.h"

#include <memory>

namespace qplc {

/// A TCP connection that carries frames, whole ones again at the other end.
class StreamLink final : public CyclicLink
{
public:
    /// Takes over the connected TCP socket \a descriptor.
    static std::unique_ptr<CyclicLink> make(int descriptor, const FrameCutter &cutter, std::size_t largestFrame);

    Status receive(const char **frame, std::size_t *size) noexcept override { return read(frame, size, 0); }
    Status poll(const char **frame, std::size_t *size) noexcept override;
    bool send(const char *frame, std::size_t size) noexcept override
    {
        return m_sender.send(m_descriptor, frame, size, 0);
    }

private:
    StreamLink(int descriptor, const FrameCutter &cutter, std::size_t largestFrame);
    Status read(const char **frame, std::size_t *size, int flags) noexcept;

    FrameCutter m_cutter;
    FrameBuffer m_buffer;
    StreamSender m_sender;
};

}  // namespace qplc

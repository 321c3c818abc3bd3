// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace qplc {

/// A node's end of its cyclic channel: whole frames to and from the master.
///
/// Made by the thread that owns the node, then used by its cycle thread alone. Allocation-free once
/// made.
class CyclicLink
{
public:
    enum Status {
        Received,  ///< a frame is there
        Nothing,   ///< the wait was interrupted (see realtime/InterruptibleWaits.h); poll(): none is there
        Closed     ///< the link is gone for good
    };

    virtual ~CyclicLink();
    CyclicLink(const CyclicLink &) = delete;
    CyclicLink &operator=(const CyclicLink &) = delete;

    /// Waits for the next frame; \a frame stays valid until the next call.
    virtual Status receive(const char **frame, std::size_t *size) noexcept = 0;
    /// As receive(), without waiting.
    virtual Status poll(const char **frame, std::size_t *size) noexcept = 0;
    /// \return false when the frame could not be handed to the kernel (it is lost, as on any
    ///         network)
    virtual bool send(const char *frame, std::size_t size) noexcept = 0;

    /// Readable while a frame is there; -1: the link has none.
    virtual int descriptor() const noexcept { return m_descriptor; }
    /// To be called behind the last frame of an answer.
    virtual void flush() noexcept {}

protected:
    explicit CyclicLink(int descriptor)
        : m_descriptor(descriptor)
    {
    }
    /// Whether \a error of a system call says: nothing now, maybe later.
    static bool isTransient(int error);

    int m_descriptor;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FrameCutter.h"
#include "SocketAddress.h"

#include <QtCore/QString>

#include <cstdint>
#include <memory>
#include <sys/types.h>

namespace qplc {

/// A node's end of its cyclic channel: whole frames to and from the master.
///
/// Made by the thread that owns the node, then used by its cycle thread alone. Allocation-free once made.
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
    /// \return false when the frame could not be handed to the kernel (it is lost, as on any network)
    virtual bool send(const char *frame, std::size_t size) noexcept = 0;

    /// UDP only: from now on frames come from the multicast group, and from the master alone. \return false, with the reason in \a error
    virtual bool joinGroup(const SocketAddress &group, QString *error);

    /// To be called behind the last frame of an answer.
    virtual void flush() noexcept {}

    /// What a master on this machine names for its link, each as "/proc/PID/fd/N".
    struct LocalPaths
    {
        QString channel;   // memory of a SharedChannel
        QString doorbell;  // memory of a Doorbell
        QString pipe;      // what wakes the master
    };
    /// The link to a master on this machine. Opens only sealed memory and a pipe that belong to \a owner, the user of the master: see PeerFile.
    /// Null, with the reason in \a error, when it cannot be opened.
    static std::unique_ptr<CyclicLink> local(const LocalPaths &paths, uid_t owner, QString *error);
    /// A UDP socket that exchanges datagrams with \a master only. Null, with the reason in \a error, when there is none to be had.
    static std::unique_ptr<CyclicLink> udp(const SocketAddress &master, quint16 *localPort, QString *error);
    /// Takes over the connected TCP socket \a descriptor.
    static std::unique_ptr<CyclicLink> tcp(int descriptor, const FrameCutter &cutter, std::size_t largestFrame);

protected:
    explicit CyclicLink(int descriptor)
        : m_descriptor(descriptor)
    {
    }
    int m_descriptor;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SocketAddress.h"

#include <QtCore/QString>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <poll.h>
#include <vector>

namespace qplc {

class HubTransport;
struct PeerFaults;

/// One node as a CyclicHub reaches it. Each transport has peers of a class of its own.
class HubPeer
{
public:
    virtual ~HubPeer();
    HubPeer(const HubPeer &) = delete;
    HubPeer &operator=(const HubPeer &) = delete;

    /// Whether frames may be lost on the way, so that a request is worth repeating.
    virtual bool losesFrames() const { return false; }
    /// Whether the connection is gone; nothing more will come.
    virtual bool isClosed() const { return false; }
    /// Whether a frame has begun and waits for the kernel to take the rest.
    virtual bool hasRest() const { return false; }

    /// Frames that were not taken, by the kernel or the memory of the node.
    std::uint64_t sendFailures = 0;
    /// Whether its answer is not worth waiting for.
    bool isListener = false;
    /// Whatever the owner wants to find again when a frame of this peer arrives.
    void *owner = nullptr;

protected:
    HubPeer();

private:
    friend class CyclicHub;
    HubTransport *m_transport = nullptr;   // null: not asked for yet
    std::unique_ptr<PeerFaults> m_faults;  // null: frames go their way
};

/// A frame that has arrived.
struct HubFrame
{
    HubPeer *peer = nullptr;
    const char *bytes = nullptr;
    std::size_t size = 0;
};

/// What has arrived at a hub, and was not handed out as it came.
struct HubArrivals
{
    std::uint64_t floods = 0;     // how often frames were left to the next wait: there were more than FramesPerWait
    std::uint64_t strangers = 0;  // frames whose sender is no peer
};

/// One way on which frames travel between a master and its nodes. A CyclicHub has one object of
/// each registered class.
///
/// open() ... detach() are called by the owner of the hub, the others by its cycle thread: these
/// allocate nothing. A wait goes like this: waitAlone(), or else beginWait() of each transport, one
/// poll() of all descriptors, endWait() of each; then next() until there is nothing left.
class HubTransport
{
public:
    /// Most peers of a hub.
    static constexpr std::size_t MaximumPeers = 1024;
    /// Most frames of a peer, or of a socket, that next() hands out after a wait, up to a batch
    /// more: a flood cannot keep the caller from its other work. The next wait goes on with the
    /// rest.
    static constexpr std::size_t FramesPerWait = 256;

    HubTransport();
    virtual ~HubTransport();
    HubTransport(const HubTransport &) = delete;
    HubTransport &operator=(const HubTransport &) = delete;

    /// The master listens at \a address. \return false, with the reason in \a error
    virtual bool open(const SocketAddress &address, QString *error) = 0;
    virtual void close() = 0;
    /// Whether \a peer was made by this class.
    virtual bool owns(const HubPeer &peer) const noexcept = 0;
    /// From now on the frames of \a peer are handed out. \pre owns(*peer)
    virtual void attach(HubPeer *peer) noexcept = 0;
    virtual void detach(HubPeer *peer) noexcept = 0;
    virtual std::size_t peerCount() const noexcept = 0;
    /// Whether nothing can arrive or leave now: the hub passes it over.
    virtual bool isIdle() const noexcept { return peerCount() == 0; }
    /// Appends the descriptors to poll, descriptorCount() of them.
    virtual void addDescriptors(std::vector<pollfd> *descriptors) const = 0;
    virtual std::size_t descriptorCount() const noexcept { return 1; }

    /// Sends \a frame, or keeps the pointer until flush(). \return false when it was not taken; it
    /// may be offered again
    virtual bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept = 0;
    /// Goes on with a frame that was taken and not sent as a whole.
    virtual void sendRest(HubPeer * /*peer*/) noexcept {}
    virtual void flush() noexcept {}

    /// Waits at most \a timeout [ns] in a cheaper way than poll(). Called when all peers are those
    /// of this transport.
    /// \return false when this transport has none: \a arrived is not set
    virtual bool waitAlone(std::int64_t /*timeout*/, bool * /*arrived*/) noexcept { return false; }
    /// \return whether the hub may sleep: nothing is there yet, and what comes wakes it
    virtual bool beginWait(bool /*isToSleep*/) noexcept { return true; }
    /// \param polled  the descriptors of addDescriptors() as poll() has left them
    /// \return whether there may be frames for next()
    virtual bool endWait(pollfd *polled) noexcept = 0;
    /// Hands out the next frame that is there; it stays valid until the next call. \return false
    /// when there is none
    virtual bool next(HubFrame *frame) noexcept = 0;

    /// Frames since open() that the kernel had no room for, as nobody read those before them in
    /// time.
    virtual std::uint64_t unread() const { return 0; }
    /// Frames that the kernel has kept off so far, as their senders are no peers. Any thread.
    virtual std::uint64_t keptOff() const { return 0; }

protected:
    HubArrivals &arrivals() noexcept { return *m_arrivals; }

private:
    friend class CyclicHub;
    HubArrivals *m_arrivals = nullptr;  // of the hub
};

}  // namespace qplc

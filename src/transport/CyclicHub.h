// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HubFaults.h"
#include "HubTransport.h"

#include <QtCore/QString>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// The master's end of the cyclic channels of all nodes: sends many frames and takes many answers
/// with few system calls.
///
/// open() by the owner; everything else by the cycle thread (or by nobody while it runs).
/// Allocation-free after construction.
class CyclicHub
{
public:
    static constexpr std::size_t MaximumPeers = HubTransport::MaximumPeers;

    /// With a transport of each kind that is registered.
    CyclicHub();
    ~CyclicHub();
    CyclicHub(const CyclicHub &) = delete;
    CyclicHub &operator=(const CyclicHub &) = delete;

    /// Opens all transports for a master that listens at \a address. \return false, with the reason
    /// in \a error
    bool open(const SocketAddress &address, QString *error);
    void close();
    /// Adds a way on which frames travel. By the owner, before open().
    void add(std::unique_ptr<HubTransport> transport);
    /// The transport of this class. \pre there is one
    template<typename Transport>
    Transport *find() const
    {
        Transport *found = nullptr;
        for (const auto &transport : m_transports)
            found = found ? found : dynamic_cast<Transport *>(transport.get());
        return found;
    }

    /// From now on frames of peers are treated like those on a bad network, or no longer. By the
    /// owner, while there are no peers.
    /// \param time  instead of the clock of the machine; for tests
    void setFaults(const std::optional<FaultPlan> &plan, TimeSource &time = TimeSource::monotonic());
    /// Makes \a peer meet these faults, if there are any. By its owner, before attach(). \param
    /// stream tells peers apart
    void exposeToFaults(HubPeer &peer, std::uint64_t stream) const;

    void attach(HubPeer *peer) noexcept;
    void detach(HubPeer *peer) noexcept;

    /// Sends \a frame, or keeps the pointer until flush() for one common system call: the bytes
    /// have to stay.
    /// \return false when a peer did not take the frame; it may be offered again
    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept;
    /// Goes on with a frame that a stream has taken and not sent as a whole.
    void sendRest(HubPeer *peer) noexcept { transportOf(*peer).sendRest(peer); }
    void flush() noexcept;

    /// Waits until frames are there, at most \a timeout [ns] (0: just looks); a wait of 20 ms or
    /// more may end before.
    /// \param alarm a descriptor that ends the wait when it becomes readable, instead of the
    ///         timeout; -1: none
    /// \return whether frames can be taken by next()
    bool wait(std::int64_t timeout, int alarm = -1) noexcept;
    /// The next frame of those that are there; it stays valid until the next call. \return false
    /// when there is none any more
    bool next(HubFrame *frame) noexcept;

    /// Frames that were read, and whose sender is no peer.
    std::uint64_t strangers() const noexcept { return m_arrivals.strangers; }
    /// Frames of strangers that the kernel has kept off so far. Any thread.
    std::uint64_t keptOff() const;
    /// How often frames were left to the next wait(), as there were more than
    /// HubTransport::FramesPerWait.
    std::uint64_t floods() const noexcept { return m_arrivals.floods; }
    /// Frames since open() that the kernel had no room for, as nobody read those before them in
    /// time. Thread of the owner.
    std::uint64_t unread() const;

private:
    HubTransport &transportOf(HubPeer &peer) const noexcept;
    void flushNow() noexcept;
    void sendDelayed() noexcept;
    bool waitForArrivals(std::int64_t timeout, int alarm) noexcept;
    bool pollDescriptors(std::int64_t timeout, int alarm) noexcept;
    bool nextArrived(HubFrame *frame) noexcept;
    void rebuild() noexcept;

    std::vector<std::unique_ptr<HubTransport>> m_transports;
    std::vector<HubPeer *> m_peers;
    std::vector<HubTransport *> m_busy;  // those that are not idle
    std::vector<pollfd> m_polled;        // those of m_busy in order, and the alarm as the last one
    HubArrivals m_arrivals;
    std::unique_ptr<HubFaults> m_faults;  // null: none are wanted
};

}  // namespace qplc

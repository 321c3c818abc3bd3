// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FrameCutter.h"
#include "HubFaults.h"
#include "SharedChannel.h"
#include "SocketAddress.h"
#include "StreamSender.h"

#include <QtCore/QString>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

struct pollfd;

namespace qplc {

/// One node at the master's end of the cyclic channels. Made by the thread that owns the master, used by the cycle thread between attach() and detach().
class HubPeer
{
public:
    /// A node that is reached at \a address over the UDP socket of the hub.
    static std::unique_ptr<HubPeer> udp(const SocketAddress &address);
    /// Takes over the connected TCP socket \a descriptor.
    static std::unique_ptr<HubPeer> tcp(int descriptor, const FrameCutter &cutter, std::size_t largestFrame);
    /// A node of this machine that shares \a memory, a SharedChannel.
    static std::unique_ptr<HubPeer> local(std::unique_ptr<SharedMemory> memory);
    ~HubPeer();
    HubPeer(const HubPeer &) = delete;
    HubPeer &operator=(const HubPeer &) = delete;

    bool isUdp() const { return m_descriptor < 0 && !m_memory; }
    bool isStream() const { return m_descriptor >= 0; }
    bool isLocal() const { return m_memory != nullptr; }
    /// A peer whose answer is not worth waiting for.
    bool isListener = false;
    /// The TCP connection is gone; nothing more will come.
    bool isClosed() const { return m_closed; }
    /// Frames that the kernel did not take.
    std::uint64_t sendFailures() const { return m_sendFailures; }
    /// A TCP connection on which a frame has begun and waits for the kernel to take the rest.
    bool hasRest() const { return m_sender && m_sender->hasRest(); }
    /// Whatever the owner wants to find again when a frame of this peer arrives.
    void *owner = nullptr;

private:
    friend class CyclicHub;
    HubPeer() = default;
    bool sendStream(const char *frame, std::size_t size) noexcept;

    SharedChannel *channel() const { return static_cast<SharedChannel *>(m_memory->data()); }

    SocketAddress m_address;
    int m_descriptor = -1;
    std::unique_ptr<SharedMemory> m_memory;
    bool m_toBeWoken = false;
    FrameCutter m_cutter;
    std::unique_ptr<FrameBuffer> m_received;
    std::optional<StreamSender> m_sender;
    std::uint64_t m_sendFailures = 0;
    bool m_closed = false;
    std::unique_ptr<PeerFaults> m_faults;  // null: frames go their way
};

/// The master's end of the cyclic channels of all nodes: sends many frames and takes many answers with few system calls.
///
/// open() by the owner; everything else by the cycle thread (or by nobody while it runs). Allocation-free after construction.
class CyclicHub
{
public:
    static constexpr std::size_t MaximumPeers = 1024;
    /// Most datagrams, and most frames of each local node, that next() reads after a wait(), up to a batch more: a flood cannot keep the caller from its other work. The next
    /// wait() goes on with the rest.
    static constexpr std::size_t FramesPerWait = 256;

    struct Incoming
    {
        HubPeer *peer = nullptr;  // null: a stranger's datagram
        const char *frame = nullptr;
        std::size_t size = 0;
    };

    /// What local nodes need to wake the master: paths that they open.
    struct LocalPaths
    {
        QString doorbell;  // memory of a Doorbell
        QString pipe;
    };

    CyclicHub();
    ~CyclicHub();
    CyclicHub(const CyclicHub &) = delete;
    CyclicHub &operator=(const CyclicHub &) = delete;

    /// Binds the UDP socket. One that is bound to :: also exchanges datagrams with IPv4 addresses. \return false, with the reason in \a error
    bool open(const SocketAddress &address, QString *error);
    void close();
    /// Lets datagrams to multicast groups leave by the interface of \a address, for one hop. \return false, with the reason in \a error
    bool openMulticast(const QHostAddress &address, QString *error);
    /// \return false, with the reason in \a error, when there is no local link to be had
    bool openLocal(QString *error);
    LocalPaths localPaths() const;

    /// From now on frames of peers are treated like those on a bad network, or no longer. By the owner, while there are no peers. \param time  instead of the clock of the machine; for tests
    void setFaults(const std::optional<FaultPlan> &plan, TimeSource &time = TimeSource::monotonic());
    /// Makes \a peer meet these faults, if there are any. By its owner, before attach(). \param stream  tells peers apart
    void exposeToFaults(HubPeer &peer, std::uint64_t stream) const;

    void attach(HubPeer *peer) noexcept;
    void detach(HubPeer *peer) noexcept;

    /// Sends \a frame, or keeps the pointer until flush() for one common system call: the bytes have to stay.
    /// \return false when a stream did not take the frame; it may be offered again
    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept;
    /// Goes on with a frame that a stream has taken and not sent as a whole.
    void sendRest(HubPeer *peer) noexcept;
    void flush() noexcept;

    /// Waits until frames are there, at most \a timeout [ns] (0: just looks); a wait of 20 ms or more may end before.
    /// \param alarm  a descriptor that ends the wait when it becomes readable, instead of the timeout; -1: none
    /// \return whether frames can be taken by next()
    bool wait(std::int64_t timeout, int alarm = -1) noexcept;
    /// The next frame of those that are there; it stays valid until the next call. \return false when there is none any more
    bool next(Incoming *incoming) noexcept;

    /// Datagrams whose sender is no peer.
    std::uint64_t strangers() const { return m_strangers; }
    /// How often frames were left to the next wait(), as there were more than FramesPerWait.
    std::uint64_t floods() const { return m_floods; }
    /// Datagrams since open() that the kernel had no room for, as nobody read those before them in time. Thread of the owner.
    std::uint64_t unread() const;

private:
    static constexpr std::size_t Batch = 32;
    static constexpr std::size_t LargestDatagram = 2048;
    static constexpr std::size_t TableSize = 4 * MaximumPeers;
    enum Polled : std::size_t { Datagrams, Pipe, Alarm, FirstStream };  // places in m_polled
    struct Messages;

    bool sendNow(HubPeer *peer, const char *frame, std::size_t size) noexcept;
    void flushNow() noexcept;
    void sendDelayed() noexcept;
    bool waitForArrivals(std::int64_t timeout, int alarm) noexcept;
    bool nextArrived(Incoming *incoming) noexcept;
    bool waitForDescriptors(std::int64_t timeout, int alarm) noexcept;
    bool pollDescriptors(std::int64_t timeout, int alarm) noexcept;
    void wakeLocals() noexcept;
    bool nextLocal(Incoming *incoming) noexcept;
    Doorbell *doorbell() const noexcept { return static_cast<Doorbell *>(m_doorbell.data()); }
    bool waitInReceive() noexcept;
    int receiveDatagrams(int flags) noexcept;
    HubPeer *find(const SocketAddress &address) noexcept;
    void rebuild() noexcept;
    bool nextDatagram(Incoming *incoming) noexcept;
    bool nextFromStream(Incoming *incoming) noexcept;

    int m_udp = -1;
    bool m_isIpv6 = false;
    std::vector<HubPeer *> m_peers;
    std::vector<pollfd> m_polled;      // see Polled; then the TCP peers in order
    std::vector<HubPeer *> m_streams;  // peer of m_polled[i + FirstStream]
    std::vector<HubPeer *> m_locals;
    std::size_t m_udpPeers = 0;
    std::array<HubPeer *, TableSize> m_table{};
    std::unique_ptr<Messages> m_messages;
    std::size_t m_outgoing = 0;  // datagrams waiting for flush()
    std::size_t m_arrived = 0;   // datagrams of the last recvmmsg
    std::size_t m_taken = 0;     // of them handed out
    bool m_moreDatagrams = false;
    std::size_t m_stream = 0;  // next stream to look at
    SharedMemory m_doorbell;
    int m_pipe[2] = {-1, -1};  // read, written
    std::size_t m_local = 0;   // next local peer to look at
    std::uint32_t m_rung = 0;  // count of the doorbell when the rings were looked at last
    bool m_localsToWake = false;
    std::array<char, LargestDatagram> m_localFrame{};
    std::size_t m_read = 0;         // datagrams since the last wait()
    std::size_t m_readOfLocal = 0;  // frames of m_local since then
    bool m_isFlooded = false;       // local frames were left unread
    std::uint64_t m_strangers = 0;
    std::uint64_t m_floods = 0;
    std::unique_ptr<HubFaults> m_faults;  // null: none are wanted
};

}  // namespace qplc

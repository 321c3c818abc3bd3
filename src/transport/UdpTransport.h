// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DatagramProbe.h"
#include "FrameVolume.h"
#include "HubTransport.h"

#include <array>

namespace qplc {

/// Datagrams over one UDP port: many peers with few system calls.
///
/// The kernel keeps datagrams of strangers apart: they wake nobody and take no room from others.
class UdpTransport final : public HubTransport
{
public:
    UdpTransport();
    ~UdpTransport() override;

    /// A node that is reached at \a address, and sends \a answers in a cycle: from now on until it
    /// is deleted, its datagrams are not those of a stranger. Not by the cycle thread.
    std::unique_ptr<HubPeer> peer(const SocketAddress &address, const FrameVolume &answers = {});
    /// Answers the questions that come from \a address, from the port of the master. Null: it is
    /// not possible.
    std::unique_ptr<ProbeAnswers> answerProbe(const SocketAddress &address, const ProbeNumbers &numbers) const;

    /// Binds the sockets. Those that are bound to :: also exchange datagrams with IPv4 addresses.
    bool open(const SocketAddress &address, QString *error) override;
    void close() override;
    /// Datagrams to the multicast group \a group leave by the interface of \a address, for one hop.
    /// Without a group there is none.
    /// \return false, with the reason in \a error
    bool openGroup(const QHostAddress &address, const QHostAddress &group, QString *error);
    /// Where datagrams for many nodes go; of length 0 when there is no group.
    SocketAddress group() const { return m_group; }
    bool owns(const HubPeer &peer) const noexcept override;
    void attach(HubPeer *peer) noexcept override;
    void detach(HubPeer *peer) noexcept override;
    std::size_t peerCount() const noexcept override { return m_peers.size(); }
    bool isIdle() const noexcept override { return m_socket < 0 && m_peers.empty(); }  // nodes may send too early
    void addDescriptors(std::vector<pollfd> *descriptors) const override;

    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept override;
    void flush() noexcept override;
    bool waitAlone(std::int64_t timeout, bool *arrived) noexcept override;
    bool endWait(pollfd *polled) noexcept override;
    bool next(HubFrame *frame) noexcept override;

    std::uint64_t unread() const override;
    std::uint64_t keptOff() const override;

private:
    class Peer;
    class Port;
    class ProbePort;
    struct Messages;
    static constexpr std::size_t Batch = 32;
    static constexpr std::size_t LargestDatagram = 2048;
    static constexpr std::size_t TableSize = 4 * MaximumPeers;

    static std::size_t placeOf(std::uint64_t key) noexcept;
    Peer *find(const SocketAddress &address) noexcept;
    void rebuild() noexcept;
    bool readMore() noexcept;
    int receive(int flags) noexcept;

    std::shared_ptr<Port> m_port;  // its peers may last longer
    int m_socket = -1;             // of the port; -1: not open
    bool m_isIpv6 = false;
    SocketAddress m_group;
    std::vector<Peer *> m_peers;
    std::array<Peer *, TableSize> m_table{};  // by address
    std::unique_ptr<Messages> m_messages;
    std::size_t m_outgoing = 0;  // datagrams waiting for flush()
    std::size_t m_arrived = 0;   // datagrams of the last recvmmsg()
    std::size_t m_taken = 0;     // of them handed out
    std::size_t m_read = 0;      // since the last wait
    bool m_hasMore = false;      // in the kernel
};

}  // namespace qplc

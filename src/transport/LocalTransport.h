// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HubTransport.h"
#include "LocalListener.h"
#include "SharedChannel.h"

#include <array>

namespace qplc {

/// Memory that the master shares with each peer, and one doorbell for all of them.
class LocalTransport final : public HubTransport
{
public:
    LocalTransport();
    ~LocalTransport() override;

    /// Takes local nodes of the master with this session. \return false, with the reason in \a
    /// error
    bool listen(std::uint64_t session, QString *error) { return m_listener.open(session, error); }
    /// A node that has connected with \a key: memory for \a volume is passed to it.
    /// \return null, with the reason in \a error
    std::unique_ptr<HubPeer> link(std::uint64_t key, const CycleVolume &volume, QString *error);
    /// A node that shares \a channel.
    static std::unique_ptr<HubPeer> peer(std::unique_ptr<SharedChannel> channel);

    bool open(const SocketAddress &address, QString *error) override;
    void close() override { m_listener.close(); }
    bool owns(const HubPeer &peer) const noexcept override;
    void attach(HubPeer *peer) noexcept override;
    void detach(HubPeer *peer) noexcept override;
    std::size_t peerCount() const noexcept override { return m_peers.size(); }
    void addDescriptors(std::vector<pollfd> *descriptors) const override;

    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept override;
    void flush() noexcept override;
    bool waitAlone(std::int64_t timeout, bool *arrived) noexcept override;
    bool beginWait(bool isToSleep) noexcept override;
    bool endWait(pollfd *polled) noexcept override;
    bool next(HubFrame *frame) noexcept override;

private:
    class Peer;
    static constexpr std::size_t LargestFrame = 2048;

    Doorbell *doorbell() const noexcept { return static_cast<Doorbell *>(m_doorbell.data()); }
    bool look() noexcept;

    LocalListener m_listener;
    SharedMemory m_doorbell;
    int m_pipe[2] = {-1, -1};  // read, written
    std::vector<Peer *> m_peers;
    std::size_t m_next = 0;        // to look at
    std::size_t m_read = 0;        // frames of it since the last wait
    std::uint32_t m_rung = 0;      // count of the doorbell when the peers were looked at last
    bool m_isFlooded = false;      // frames were left unread
    bool m_areSomeToWake = false;  // of the peers
    std::array<char, LargestFrame> m_frame{};
};

}  // namespace qplc

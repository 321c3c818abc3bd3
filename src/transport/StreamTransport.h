// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FrameCutter.h"
#include "HubTransport.h"

namespace qplc {

/// A TCP connection for each peer.
class StreamTransport final : public HubTransport
{
public:
    StreamTransport();
    ~StreamTransport() override;

    /// Takes over the connected TCP socket \a descriptor.
    static std::unique_ptr<HubPeer> peer(int descriptor, const FrameCutter &cutter, std::size_t largestFrame);

    bool open(const SocketAddress & /*address*/, QString * /*error*/) override { return true; }
    void close() override {}
    bool owns(const HubPeer &peer) const noexcept override;
    void attach(HubPeer *peer) noexcept override;
    void detach(HubPeer *peer) noexcept override;
    std::size_t peerCount() const noexcept override { return m_peers.size(); }
    void addDescriptors(std::vector<pollfd> *descriptors) const override;
    std::size_t descriptorCount() const noexcept override { return m_peers.size(); }

    bool send(HubPeer *peer, const char *frame, std::size_t size) noexcept override;
    void sendRest(HubPeer *peer) noexcept override;
    bool endWait(pollfd *polled) noexcept override;
    bool next(HubFrame *frame) noexcept override;

private:
    class Peer;
    bool nextOf(Peer &peer, pollfd *polled, HubFrame *frame) noexcept;

    std::vector<Peer *> m_peers;
    pollfd *m_polled = nullptr;  // of m_peers, in the same order
    std::size_t m_next = 0;      // to look at
};

}  // namespace qplc

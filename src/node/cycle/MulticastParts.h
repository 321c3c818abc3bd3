// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SentCycles.h"
#include "protocol/CyclicFrame.h"
#include "transport/CyclicHub.h"

#include <memory>
#include <vector>

namespace qplc {

struct NodeSlot;

/// One frame that carries the inputs of several nodes: u16 number of the part, then the input
/// payload of each of them.
///
/// Made by the thread of the master before its nodes are asked for the first time; from then on the
/// cycle thread's.
struct MulticastPart
{
    std::uint16_t number = 0;
    std::uint64_t hash = 0;  // over "node:size@offset\n" of all its nodes
    FrameEncoder encoder;
    std::unique_ptr<HubPeer> group;
    quint32 payloadSize = sizeof(std::uint16_t);  // [byte]
    std::vector<char> frame;                      // its nodes write their inputs into it
    bool toBeSent = false;
    SentCycles sentCycles;

    char *payload() { return frame.data() + CyclicHeaderSize; }
    /// Sends the payload as it is now. The bytes have to stay until the hub is flushed.
    void send(CyclicHub &hub, const FrameHeader &header) noexcept;
};

/// Puts the nodes of transports with groups into parts. A part never changes once its nodes know
/// it: who joins while others run gets a part of its own, who leaves leaves a gap.
class MulticastParts
{
public:
    /// Most bytes of the inputs of a node.
    static constexpr std::size_t MaximumInputs = MaximumCyclicPayload - sizeof(std::uint16_t);

    /// Forgets all parts: a new phase begins.
    void restart(std::uint64_t session, const CyclicHub &hub);
    /// Gives \a slot its place. \pre its inputs have at most MaximumInputs bytes
    void add(NodeSlot &slot);
    /// Makes the parts that have been begun ready.
    void finish();

private:
    std::uint64_t m_session = 0;
    const CyclicHub *m_hub = nullptr;
    std::uint16_t m_next = 0;
    std::shared_ptr<MulticastPart> m_open;
    std::vector<NodeSlot *> m_nodes;  // of m_open
};

}  // namespace qplc

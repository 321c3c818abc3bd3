// SPDX-License-Identifier: Apache-2.0
#include "MulticastParts.h"

#include "NodeSlot.h"
#include "protocol/LittleEndian.h"
#include "signals/Fnv1a.h"

namespace qplc {

void MulticastPart::send(CyclicHub &hub, const FrameHeader &header) noexcept
{
    encoder.encode(0, header, payload(), frame.data());
    hub.send(group.get(), frame.data(), frame.size());
    toBeSent = false;
}

void MulticastParts::restart(std::uint64_t session, const CyclicHub &hub)
{
    m_session = session;
    m_hub = &hub;
    m_next = 0;
    m_open.reset();
    m_nodes.clear();
}

void MulticastParts::add(NodeSlot &slot)
{
    const bool isOfAnotherKind = m_open && m_nodes.front()->transport != slot.transport;
    if (isOfAnotherKind || (m_open && m_open->payloadSize + slot.inputLayout.size() > MaximumCyclicPayload))
        finish();
    if (!m_open) {
        m_open = std::make_shared<MulticastPart>();
        m_open->number = m_next++;
    }
    slot.multicast = m_open;
    slot.multicastOffset = m_open->payloadSize;
    m_open->payloadSize += slot.inputLayout.size();
    m_nodes.push_back(&slot);
}

void MulticastParts::finish()
{
    if (!m_open)
        return;
    QByteArray text;
    for (const NodeSlot *slot : m_nodes)
        text += QByteArray::number(slot->id) + ':' + QByteArray::number(slot->inputLayout.size()) + '@'
            + QByteArray::number(slot->multicastOffset) + '\n';
    m_open->hash = fnv1a64(text);
    m_open->encoder = FrameEncoder(FrameKind::GroupInputs, {m_session, 0, m_open->hash}, {0, m_open->payloadSize});
    m_open->frame.resize(m_open->encoder.totalSize());
    storeLittle(m_open->number, m_open->payload());
    for (NodeSlot *slot : m_nodes)
        slot->inputs = m_open->payload() + slot->multicastOffset;
    m_open->group = m_nodes.front()->transport->makeGroupPeer(*m_hub);
    m_open.reset();
    m_nodes.clear();
}

}  // namespace qplc

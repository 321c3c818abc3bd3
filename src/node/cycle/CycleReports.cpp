// SPDX-License-Identifier: Apache-2.0
#include "CycleReports.h"

#include <algorithm>
#include <cstring>

namespace qplc {

CycleReports::CycleReports(bool tapFrames)
    : m_frames(tapFrames ? std::make_unique<SpscRing<TappedFrame>>(512) : nullptr)
{
    m_wakeUp.arm();
}

/// Places of the ring that events of this kind leave to those that weigh more.
std::size_t CycleReports::reserveAgainst(CycleEvent::Kind kind) noexcept
{
    switch (kind) {
    case CycleEvent::LateAnswer:
    case CycleEvent::ForgedFrame:
    case CycleEvent::ValueRefused:
    case CycleEvent::SourceChanged:
    case CycleEvent::SignalSafe:
        return Capacity / 2;
    case CycleEvent::WaitingForNode:
    case CycleEvent::WaitingEnded:
    case CycleEvent::NodeFaulted:
    case CycleEvent::LinkClosed:
        return Capacity / 16;
    default:
        return 0;
    }
}

void CycleReports::post(const CycleEvent &event) noexcept
{
    if (!m_events.push(event, reserveAgainst(event.kind)))
        m_dropped.fetch_add(1, std::memory_order_relaxed);
    m_wakeUp.notify();
}

void CycleReports::keep(TappedFrame::Direction direction, std::uint16_t node, const char *frame,
                        std::size_t size) noexcept
{
    TappedFrame *place = m_frames->beginPush();
    if (!place) {
        m_dropped.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    place->direction = direction;
    place->node = node;
    place->size = std::uint16_t(std::min(size, TappedFrame::Capacity));
    std::memcpy(place->bytes.data(), frame, place->size);
    m_frames->commitPush();
    m_wakeUp.notify();
}

}  // namespace qplc

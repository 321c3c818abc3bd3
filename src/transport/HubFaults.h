// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FaultStream.h"
#include "realtime/TimeSource.h"

namespace qplc {

/// Both directions of one peer of a hub on a bad network.
struct PeerFaults
{
    PeerFaults(const FaultPlan &plan, std::uint64_t stream)
        : sent(plan.sent, plan.seed, 2 * stream)
        , received(plan.received, plan.seed, 2 * stream + 1)
    {
    }
    FaultStream sent;
    FaultStream received;
};

/// The frames of a CyclicHub that a FaultPlan keeps under way. Made by the owner of the hub, used
/// by its cycle thread.
class HubFaults
{
public:
    explicit HubFaults(const FaultPlan &plan, TimeSource &time = TimeSource::monotonic());

    const FaultPlan &plan() const { return m_plan; }
    std::int64_t now() noexcept { return m_time.now(); }

    /// As FaultStream::passes(), for what the hub sends to the owner of \a faults, and for what
    /// comes from it.
    bool sends(PeerFaults &faults, void *peer, const char *frame, std::size_t size) noexcept
    {
        return faults.sent.passes(m_time.now(), frame, size, m_sending, peer);
    }
    bool receives(PeerFaults &faults, void *peer, const char *frame, std::size_t size) noexcept
    {
        return faults.received.passes(m_time.now(), frame, size, m_receiving, peer);
    }
    /// What is to be sent now, or has arrived by now.
    bool takeSending(DelayLine::Frame *frame) noexcept { return m_sending.take(m_time.now(), frame); }
    bool takeReceived(DelayLine::Frame *frame) noexcept { return m_receiving.take(m_time.now(), frame); }
    /// Time until the next frame is to be sent or has arrived [ns]; not more than \a longest.
    std::int64_t timeLeft(std::int64_t longest) noexcept;
    bool hasArrived() noexcept { return m_receiving.nextDue() <= m_time.now(); }
    void forget(const void *peer) noexcept;

private:
    const FaultPlan m_plan;
    TimeSource &m_time;
    DelayLine m_sending;
    DelayLine m_receiving;
};

}  // namespace qplc

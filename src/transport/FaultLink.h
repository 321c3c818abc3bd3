// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CyclicLink.h"
#include "FaultStream.h"
#include "realtime/TimeSource.h"

#include <memory>

namespace qplc {

/// A link that treats frames like a bad network, as a FaultPlan says. A node without a plan has
/// none of it: its link is the bare one.
///
/// Frames that are under way are looked for each Look: delays are longer than said by up to that.
class FaultLink final : public CyclicLink
{
public:
    static constexpr std::int64_t Look = 200'000;  // [ns]

    /// \param stream  tells links with the same seed apart
    FaultLink(std::unique_ptr<CyclicLink> link, const FaultPlan &plan, std::uint64_t stream,
              TimeSource &time = TimeSource::monotonic());

    Status receive(const char **frame, std::size_t *size) noexcept override;
    Status poll(const char **frame, std::size_t *size) noexcept override;
    bool send(const char *frame, std::size_t size) noexcept override;
    void flush() noexcept override { m_link->flush(); }

    const FaultInjector &sent() const { return m_sent.injector(); }
    const FaultInjector &received() const { return m_received.injector(); }

private:
    void sendDue() noexcept;
    bool takeDue(const char **frame, std::size_t *size) noexcept;

    const std::unique_ptr<CyclicLink> m_link;
    TimeSource &m_time;
    FaultStream m_sent;
    FaultStream m_received;
    DelayLine m_sending;
    DelayLine m_receiving;
};

}  // namespace qplc

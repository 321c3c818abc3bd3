// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

namespace qplc {

/// Until when a signal belongs to its holder. The thread of the master renews it, the cycle thread
/// ends it: exactly once, and no renewal brings it back. Times are ns on any steady clock.
class LeaseTerm
{
public:
    explicit LeaseTerm(std::int64_t deadline)
        : m_deadline(deadline)
    {
    }
    /// When it is over without a renewal.
    std::int64_t deadline() const noexcept { return m_deadline.load(std::memory_order_relaxed); }
    bool hasEnded() const noexcept { return deadline() == Ended; }
    /// Does nothing when it is over at \a now.
    void renew(std::int64_t now, std::int64_t newDeadline) noexcept
    {
        std::int64_t present = deadline();
        while (present > now && !m_deadline.compare_exchange_weak(present, newDeadline, std::memory_order_relaxed)) {}
    }
    /// Ends it if it is over at \a now. \return whether it was this call that ended it
    bool end(std::int64_t now) noexcept
    {
        std::int64_t present = deadline();
        return present != Ended && present <= now
            && m_deadline.compare_exchange_strong(present, Ended, std::memory_order_relaxed);
    }

private:
    static constexpr std::int64_t Ended = std::numeric_limits<std::int64_t>::min();

    std::atomic<std::int64_t> m_deadline;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "StepGate.h"

#include "realtime/Host.h"
#include "realtime/TimeSource.h"

namespace qplc {

StepGate::Answer StepGate::enter() noexcept
{
    unsigned expected = 0;
    if (!m_state.compare_exchange_strong(expected, IsInside, std::memory_order_acq_rel))
        return expected & IsClosed ? Closed : Busy;
    m_strand.store(Host::current().runningStrand(), std::memory_order_relaxed);
    return Entered;
}

/// The one inside looks every few milliseconds whether it has to leave: a short sleep is good
/// enough for a wait that is rare.
void StepGate::close()
{
    constexpr std::int64_t pause = 1'000'000;  // [ns]
    m_state.fetch_or(IsClosed, std::memory_order_acq_rel);
    while (m_state.load(std::memory_order_acquire) & IsInside) {
        if (Strand *strand = m_strand.load(std::memory_order_relaxed))
            strand->interrupt();
        else
            TimeSource::monotonic().sleepUntil(monotonicNow() + pause);
    }
}

}  // namespace qplc

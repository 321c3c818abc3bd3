// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace qplc {

class Strand;

/// Lets one caller at a time into the cycles of a master, whichever thread it comes from, and none
/// while it is closed.
///
/// Entering and leaving cost an atomic operation each: no system call, and no lock that the owner
/// could hold.
class StepGate
{
public:
    enum Answer {
        Entered,  ///< leave() has to follow
        Busy,     ///< somebody else is inside
        Closed
    };

    // ---- any thread ----
    Answer enter() noexcept;
    void leave() noexcept { m_state.fetch_and(~IsInside, std::memory_order_acq_rel); }
    bool isOpen() const noexcept { return !(m_state.load(std::memory_order_acquire) & IsClosed); }

    // ---- owner, who is not inside ----
    void open() noexcept { m_state.fetch_and(~IsClosed, std::memory_order_acq_rel); }
    /// Lets nobody in any more, and waits until the one inside has left.
    void close();

private:
    static constexpr unsigned IsClosed = 1;
    static constexpr unsigned IsInside = 2;

    std::atomic<unsigned> m_state{IsClosed};
    std::atomic<Strand *> m_strand{nullptr};  // of the one inside, on a host without threads
};

}  // namespace qplc

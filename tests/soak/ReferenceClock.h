// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"

#include <atomic>
#include <thread>

namespace soak {

/// A thread on each processor that wakes up regularly and does nothing: when it is late, the
/// machine stood still, whatever the plant did.
class ReferenceClock
{
public:
    /// \param tolerance  [ns] lateness from which on it is written down
    ReferenceClock(HistoryWriter &history, qint64 tolerance);
    ~ReferenceClock();

private:
    void run(int processor) noexcept;

    HistoryWriter &m_history;
    const qint64 m_tolerance;
    std::atomic<bool> m_stop{false};
    std::vector<std::thread> m_threads;
};

}  // namespace soak

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>

namespace qplc {

/// While it lives, the system calls in which the calling thread waits end at least once in each period, with EINTR: a thread that waits for a frame can look at a
/// flag or a watchdog.
///
/// Why not the time limit of the socket: that is a timer which the kernel starts and stops for every single wait (a fortieth of the time of a cycle); this one just
/// runs.
///
/// The signal is SIGURG, which does nothing by default; a handler of the program's own is left as it is. Made, used and destroyed by one thread.
class PeriodicInterrupt
{
public:
    /// \param period  [ns], > 0
    explicit PeriodicInterrupt(std::int64_t period);
    ~PeriodicInterrupt();
    PeriodicInterrupt(const PeriodicInterrupt &) = delete;
    PeriodicInterrupt &operator=(const PeriodicInterrupt &) = delete;

private:
    timer_t m_timer{};
    bool m_exists = false;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>
#include <pthread.h>

namespace qplc {

class Strand;

/// While it lives, another thread can end a system call in which the calling thread waits, with
/// EINTR; on wish such waits end by themselves at an instant or in each period, too. So a thread
/// that waits for a frame can look at a flag or a watchdog.
///
/// Why not the time limit of the socket: that is a timer which the kernel starts and stops for
/// every single wait (a fortieth of the time of a cycle).
///
/// The signal is SIGURG, which does nothing by default; a handler of the program's own is left as
/// it is. Made, used and destroyed by one thread.
class InterruptibleWaits
{
public:
    /// \param period  of the interruptions that come by themselves [ns]; 0: there are none
    explicit InterruptibleWaits(std::int64_t period = 0);
    ~InterruptibleWaits();
    /// From now on a wait is ended at \a instant [ns of TimeSource::monotonic()], and each \a
    /// period [ns] behind it, since the thread may not wait just then; by nothing else.
    void interruptAt(std::int64_t instant, std::int64_t period) noexcept;
    /// Ends the wait of \a thread; nothing happens when it does not wait. Any thread; \a thread has
    /// not been joined.
    static void interrupt(pthread_t thread) noexcept;
    InterruptibleWaits(const InterruptibleWaits &) = delete;
    InterruptibleWaits &operator=(const InterruptibleWaits &) = delete;

private:
    Strand *m_strand;  // null: a thread
    timer_t m_timer{};
    bool m_exists = false;
};

}  // namespace qplc

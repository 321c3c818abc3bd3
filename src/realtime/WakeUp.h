// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Host.h"

#include <QtCore/QString>

#include <atomic>

namespace qplc {

/// How a cycle thread tells another thread that there is something in a ring. It costs a system
/// call only when the reader sleeps, and one atomic exchange otherwise.
///
/// \code
/// // The cycle thread.
/// ring.push(event);
/// wakeUp.notify();
/// // The reader: once at its start, and whenever descriptor() is readable (QSocketNotifier).
/// wakeUp.consume();
/// do { takeAll(ring); wakeUp.arm(); } while (ring.front());
/// \endcode
/// The look into the ring after arm() is what makes it safe: a value that was pushed before gives
/// no wake-up. A value that was pushed after arm() gives one, also when the reader has found it by
/// that look.
class WakeUp
{
public:
    WakeUp();
    ~WakeUp();
    WakeUp(const WakeUp &) = delete;
    WakeUp &operator=(const WakeUp &) = delete;

    /// Becomes readable when the reader is to wake up; for QSocketNotifier or poll(). -1 when the
    /// system had none left.
    int descriptor() const noexcept { return m_descriptor; }
    bool isValid() const noexcept { return m_descriptor >= 0; }
    /// Why isValid() is false; empty otherwise.
    QString errorString() const;

    /// Wakes the reader up if it has armed, once. \threadsafe yes, real-time
    void notify() noexcept
    {
        // An exchange, not a load: together with the exchange of arm() either this one sees the
        // reader armed, or the reader sees what was pushed before.
        if (m_armed.exchange(false, std::memory_order_acq_rel))
            wake();
    }
    /// From now on the next notify() wakes the reader up. Reader only.
    void arm() noexcept { m_armed.exchange(true, std::memory_order_acq_rel); }
    /// Takes the wake-up back, so that descriptor() is not readable until the next one. Reader
    /// only.
    /// \return true when there was one
    bool consume() noexcept;

private:
    void wake() noexcept { m_host.wake(m_descriptor); }

    Host &m_host;
    int m_error = 0;
    int m_descriptor = -1;
    std::atomic<bool> m_armed{false};
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// Barks when nothing was heard for a time.
///
/// Hearing is cheap: it sets no timer. Its owner looks when the alarm rings, and sets the next one:
/// while there is something to hear once in that time, and when there is not at the very instant at
/// which the time is over.
///
/// Looks at no clock; used by one thread.
class Watchdog
{
public:
    enum Answer {
        TooEarly,  ///< the alarm is still to come
        Calm,      ///< alarm() is a later one now
        Barks      ///< as Calm; nothing was heard for the whole time. Once, until something is heard
    };

    /// \param time  [ns]; 0: never barks  \param now  [ns]: begins as if it had heard something
    void start(std::int64_t time, std::int64_t now)
    {
        m_time = time;
        m_heard = now;
        m_alarm = now + time;
        m_barkedFor = now - 1;
    }
    bool isOn() const { return m_time > 0; }
    void hear(std::int64_t now) { m_heard = now; }
    std::int64_t lastHeard() const { return m_heard; }
    /// When to look next [ns].
    std::int64_t alarm() const { return m_alarm; }

    Answer look(std::int64_t now)
    {
        if (!isOn() || now < m_alarm)
            return TooEarly;
        const bool isOver = now - m_heard >= m_time;
        m_alarm = (isOver ? now : m_heard) + m_time;
        if (!isOver || m_barkedFor == m_heard)
            return Calm;
        m_barkedFor = m_heard;
        return Barks;
    }

private:
    std::int64_t m_time = 0;
    std::int64_t m_heard = 0;
    std::int64_t m_alarm = 0;
    std::int64_t m_barkedFor = -1;  // what was heard last then
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include <QtCore/QtGlobal>

namespace qplc {

/// Whether a device that fails now and then still counts as there. One bad answer is asked for
/// again at once; after that the values of the device are held, and it is lost when it has had no
/// good turn for its time-out.
///
/// A turn is one write and one read of the driver.
class DeviceHealth
{
public:
    static constexpr int DefaultRetries = 2;
    static constexpr int MostRetries = 10;

    /// It was opened: nothing is known of it. Counted errors stay.
    void reset() noexcept
    {
        m_lastGood = Never;
        m_failedTurns = 0;
        m_pause = ShortestPause;
        m_nextTry = Never;
    }
    /// How often one question may be asked. A device that fails already costs others no more time.
    int attempts(int retries) const noexcept { return m_failedTurns > 0 ? 1 : 1 + retries; }
    /// An answer was missing or damaged.
    void countError() noexcept { ++m_errors; }
    quint64 errors() const noexcept { return m_errors; }

    /// The device has answered all of this turn.
    void succeed(qint64 now) noexcept
    {
        m_lastGood = now;
        m_failedTurns = 0;
        m_pause = ShortestPause;
    }
    /// It has not.
    void fail(qint64 now, qint64 timeout) noexcept
    {
        ++m_failedTurns;
        if (isLost(now, timeout))
            pause(now);
    }
    /// It has answered that it does not do what it is asked for: it is lost until it does.
    void giveUp(qint64 now) noexcept
    {
        m_lastGood = Never;
        ++m_failedTurns;
        pause(now);
    }

    bool hasAnswered() const noexcept { return m_lastGood != Never; }
    bool isLost(qint64 now, qint64 timeout) const noexcept
    {
        return m_failedTurns > 0 && (!hasAnswered() || (m_failedTurns > 1 && now - m_lastGood > timeout));
    }
    /// Whether to ask it in this turn: a lost one is asked after growing pauses, as a device is
    /// opened.
    bool isDue(qint64 now) const noexcept { return now >= m_nextTry; }

private:
    static constexpr qint64 Never = std::numeric_limits<qint64>::min();
    static constexpr qint64 ShortestPause = 100'000'000;   // [ns]
    static constexpr qint64 LongestPause = 5'000'000'000;  // [ns]

    void pause(qint64 now) noexcept
    {
        m_nextTry = now + m_pause;
        m_pause = std::min(2 * m_pause, LongestPause);
    }

    qint64 m_lastGood = Never;  // when the last good turn began [ns]
    qint64 m_nextTry = Never;   // [ns]
    qint64 m_pause = ShortestPause;
    int m_failedTurns = 0;  // in a row
    quint64 m_errors = 0;
};

}  // namespace qplc

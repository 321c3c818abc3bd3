// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

namespace qplc {

/// Converts the stamps that the kernel gives to frames, which are of the wall clock, to the
/// monotonic clock, also when the wall clock has been set meanwhile.
///
/// A frame has come in after the queue was empty and before it was taken. Where the difference
/// between the clocks of now leads out of that time, the wall clock was set in between, and the
/// difference of before is tried.
class WallTimeConverter
{
public:
    /// After frames were taken. \param now, wall  the two clocks [ns]
    void look(qint64 now, qint64 wall) noexcept
    {
        const qint64 offset = now - wall;
        if (qAbs(offset - m_offset) > drift)
            m_before = m_offset;
        m_offset = offset;
        m_now = now;
    }
    /// All that had come in before \a time of the monotonic clock has been taken.
    void drained(qint64 time) noexcept { m_earliest = time; }

    /// \param wall  [ns] \return on the monotonic clock [ns], never in the future
    qint64 toMonotonic(qint64 wall) const noexcept
    {
        for (const qint64 offset : {m_offset, m_before}) {
            const qint64 time = wall + offset;
            if (time >= m_earliest - drift && time <= m_now + drift)
                return time < m_now ? time : m_now;
        }
        return m_now;
    }

private:
    static constexpr qint64 drift = 1'000'000;  // [ns] between two looks at most, else the wall clock was set

    qint64 m_offset = 0;  // monotonic - wall [ns]
    qint64 m_before = 0;  // until the wall clock was set
    qint64 m_now = 0;
    qint64 m_earliest = 0;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

namespace qplc {

/// Converts the stamps that the kernel gives to frames, which are of the wall clock, to the monotonic clock, also when the wall clock has been set meanwhile.
///
/// A frame has come in after the queue was empty and before now. Where the difference between the clocks of now leads out of that time, the wall clock was set in between, and
/// the difference of before is tried.
class WallTimeConverter
{
public:
    /// Before frames are taken. \param now, wall  the two clocks [ns]
    void begin(qint64 now, qint64 wall) noexcept
    {
        m_before = m_isFirst ? now - wall : m_offset;
        m_isFirst = false;
        m_offset = now - wall;
        m_now = now;
    }
    /// All that had come in before begin() has been taken.
    void drained() noexcept { m_earliest = m_now; }

    /// \param wall  [ns] \return on the monotonic clock [ns], never in the future
    qint64 toMonotonic(qint64 wall) const noexcept
    {
        constexpr qint64 tolerance = 1'000'000;  // [ns] by which the clocks drift apart between two looks
        for (const qint64 offset : {m_offset, m_before}) {
            const qint64 time = wall + offset;
            if (time >= m_earliest - tolerance && time <= m_now + tolerance)
                return time < m_now ? time : m_now;
        }
        return m_now;
    }

private:
    qint64 m_offset = 0;  // monotonic - wall [ns]
    qint64 m_before = 0;
    qint64 m_now = 0;
    qint64 m_earliest = 0;
    bool m_isFirst = true;
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace qplc {

/// The columns of pixels of a time axis.
///
/// Columns are numbered for ever: number c is the time from c to c + 1 times the width of a column,
/// counted from time 0 and not from the edge of the view. So what falls into one column stays
/// together while the view moves, and a curve moves as a whole, by whole pixels.
///
/// Below 16 us for a column, widths are no longer whole nanoseconds, and columns are counted from
/// the begin of the view: nothing that moves so fast can be followed.
class TimeColumns
{
public:
    using Time = std::int64_t;  // [ns]

    TimeColumns() = default;
    /// Columns of a view. \param begin, end [ns], begin < end; the left edge of the view is at most
    /// half a column away from that of column first()
    /// \param count  device pixels, >= 1
    TimeColumns(Time begin, Time end, int count)
        : m_count(count)
    {
        const Time span = std::max<Time>(end - begin, 1);
        if (span / count < finest) {
            m_origin = begin;
            m_shift = fractionBits;
        }
        m_width = std::max<Time>(((span << m_shift) + count / 2) / count, 1);
        m_first = columnOf(begin + span / count / 2);
    }

    /// Columns of a view of \a span [ns] whose last column is the one of \a newest: they change
    /// when a new column begins, and only then.
    static TimeColumns upTo(Time newest, Time span, int count)
    {
        TimeColumns columns(newest - span, newest, count);
        columns.m_first = columns.columnOf(newest) - count + 1;
        return columns;
    }

    /// Number of the column in which a time is.
    std::int64_t columnOf(Time time) const
    {
        const Time distance = m_shift == 0 ? time : std::clamp(time - m_origin, -farthest, farthest);
        return floorOfQuotient(distance * (Time(1) << m_shift), m_width);
    }
    /// The first time of a column.
    Time beginOf(std::int64_t column) const
    {
        return m_origin - floorOfQuotient(-column * m_width, Time(1) << m_shift);
    }
    /// The column at the left edge of the view; those of the view are first() ... first() + count()
    /// - 1.
    std::int64_t first() const { return m_first; }
    int count() const { return m_count; }
    std::int64_t end() const { return m_first + m_count; }
    /// Of a column [ns]
    double width() const { return double(m_width) / double(Time(1) << m_shift); }

    bool operator==(const TimeColumns &other) const
    {
        return m_origin == other.m_origin && m_shift == other.m_shift && m_width == other.m_width
            && m_first == other.m_first && m_count == other.m_count;
    }
    bool operator!=(const TimeColumns &other) const { return !(*this == other); }

private:
    static constexpr Time finest = 16384;  // [ns]
    static constexpr int fractionBits = 16;
    static constexpr Time farthest = Time(1) << 46;  // [ns], twenty hours

    static std::int64_t floorOfQuotient(std::int64_t dividend, std::int64_t divisor)
    {
        return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
    }

    Time m_origin = 0;
    int m_shift = 0;  // the width is counted in 2^-shift ns
    Time m_width = 1;
    std::int64_t m_first = 0;
    int m_count = 0;
};

}  // namespace qplc

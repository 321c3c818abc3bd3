// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/TimeColumns.h"
#include "gui/store/SignalStore.h"

#include <limits>
#include <vector>

namespace qplc {

/// What of a channel is seen in a view, left to right: few points, whatever the number of rows.
///
/// With two rows for a column of pixels or more, a point is a column with all that happened in it;
/// with fewer, a point is a row. The last row before the view and the first one behind it are there
/// too, so that lines lead out of it.
class CurveShape
{
public:
    struct Point
    {
        int x;          // [px] from the left edge of the view
        bool isJoined;  // a line leads here from the point before
        float first;    // NaN: a gap begins or ends within the column
        float last;
        float minimum;  // never NaN
        float maximum;
        SignalStore::Mark mark;  // the greatest one
    };

    /// Reads a channel anew; takes memory only when a view is larger than all before.
    /// \param least, most  only rows from \a least to before \a most are seen
    void read(const SignalStore &store, int channel, const TimeColumns &columns, SignalStore::Row least = 0,
              SignalStore::Row most = std::numeric_limits<SignalStore::Row>::max());

    const std::vector<Point> &points() const { return m_points; }
    /// Whether some of the points have a mark.
    bool hasMarks() const { return m_hasMarks; }
    /// Whether points are columns.
    bool isDense() const { return m_isDense; }

private:
    void readRows(const SignalStore &store, int channel, const TimeColumns &columns, SignalStore::Row begin,
                  SignalStore::Row end);
    void readColumns(const SignalStore &store, int channel, const TimeColumns &columns, SignalStore::Row begin,
                     SignalStore::Row end);
    void add(std::int64_t x, float first, float last, SignalStore::Range range, SignalStore::Mark mark);
    SignalStore::Mark markOf(const SignalStore &store, int channel, SignalStore::Row begin, SignalStore::Row end) const
    {
        return m_hasMarks ? store.greatestMark(channel, begin, end) : RowMarks::None;
    }

    std::vector<Point> m_points;
    bool m_isDense = false;
    bool m_hasMarks = false;
    bool m_isInterrupted = true;  // no line leads to what is added next
};

}  // namespace qplc

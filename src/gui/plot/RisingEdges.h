// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <deque>

namespace qplc {

/// The last moments at which a channel rose from below a level to the level or above, in all rows
/// that a store has.
///
/// A moment is the time of the first row at or above the level. None is seen across interruptions
/// and NaN. Pieces of the past that do not meet the level cost next to nothing, so that an hour at
/// a kilohertz is looked at within a picture.
///
/// ```cpp
/// RisingEdges edges(&store, channel, 0.5, 10);
/// edges.update();  // after each update of the plant: looks at the new rows
/// for (const RisingEdges::Time begin : edges.times()) ...
/// ```
class RisingEdges
{
public:
    using Time = SignalStore::Time;
    using Row = SignalStore::Row;

    static constexpr int Most = 1000;

    /// \param store  outlives this object
    /// \param count  of the last edges that are kept, 1 to Most
    /// \param apart  an edge that comes sooner after the one before does not count [ns]
    RisingEdges(const SignalStore *store, int channel, double level, int count, Time apart = 0);

    /// Looks at the rows that have come since, and forgets edges whose rows are gone.
    /// \return whether times() are others
    bool update();
    /// Oldest first.
    const std::deque<Time> &times() const { return m_times; }

private:
    bool isSame(Row begin, Row end) const;
    void look(Row row);

    const SignalStore *m_store;
    int m_channel;
    double m_level;
    std::size_t m_count;
    Time m_apart;
    Row m_next = 0;
    bool m_isBelow = false;  // the row before m_next
    std::deque<Time> m_times;
};

}  // namespace qplc

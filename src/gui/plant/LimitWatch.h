// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChannelMap.h"
#include "gui/store/SignalStore.h"

#include <vector>

namespace qplc {

/// Finds when signals leave their limits of the table, and when they are back: of every row, also
/// between two looks.
///
/// A signal is back when all its values have been within the limits for a second, so that one that
/// trembles about its limit is one violation. Knows no clock: times are those of rows.
class LimitWatch
{
public:
    using Time = SignalStore::Time;

    static constexpr Time CalmTime = 1'000'000'000;  // [ns] within the limits until it is over

    struct Change
    {
        QPlcSignalIndex signal;
        int element;
        bool isOutside;   // it begins; else it is over
        Time time;        // of the first value outside, or of the first one within for good
        Time since;       // of the first value outside
        double farthest;  // the value that is, or was, farthest outside
    };

    /// Begins anew: nothing is outside, and rows of before do not count. \param store with the
    /// channels of \a channels; null: none
    void setTable(const QPlcSignalTable &table, const ChannelMap &channels, const SignalStore *store);
    /// Looks at the rows that are new. The same store as before.
    std::vector<Change> check(const SignalStore &store);

private:
    struct Watched
    {
        QPlcSignalIndex signal;
        int element;
        int channel;
        float minimum;
        float maximum;
        bool isOutside = false;
        Time since = 0;
        Time lastOutside = 0;
        double farthest = 0.0;

        bool isBeyond(const SignalStore::Range &range) const
        {
            return !range.isEmpty() && (range.minimum < minimum || range.maximum > maximum);
        }
        /// How far outside \a value is; not above 0: inside.
        double excess(double value) const;
    };
    void look(const SignalStore &store, Watched *watched, SignalStore::Row begin, std::vector<Change> *changes);

    std::vector<Watched> m_watched;
    SignalStore::Row m_next = 0;
};

}  // namespace qplc

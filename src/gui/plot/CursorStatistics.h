// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <cmath>

namespace qplc {

/// What a curve does between two times: straight from the rows of the store, some of them at each
/// update, so that ten minutes at a kilohertz never hold up a window.
///
/// Counts the rows at or after the earlier and at or before the later time; NaN counts as nothing.
/// Mean, rms and sigma are those of the rows, each with the same weight; sigma divides by their
/// number, so rms^2 = mean^2 + sigma^2. The integral goes from row to row, straight (trapezoids) or
/// stepped, never over a gap.
///
/// ```cpp
/// statistics.set(&store, channel, scaling, a, b);  // costs nothing when nothing is new
/// const bool isComplete = statistics.advance(100'000);
/// show(statistics.result());
/// ```
class CursorStatistics
{
public:
    using Time = SignalStore::Time;
    using Row = SignalStore::Row;

    struct Scaling
    {
        double gain = 1.0;
        double offset = 0.0;
        bool isStepped = false;
        friend bool operator==(const Scaling &a, const Scaling &b)
        {
            return a.gain == b.gain && a.offset == b.offset && a.isStepped == b.isStepped;
        }
    };
    struct Result
    {
        std::int64_t count = 0;  // of rows with a number; 0: all that follows is NaN
        double minimum;
        double maximum;
        double mean;
        double rms;
        double sigma;
        double integral;  // [unit s]
    };

    /// What is to be looked at, in any order of times. Begins anew when it is something else; rows
    /// that have come in between are looked at too, and those that have gone since stay counted.
    void set(const SignalStore *store, int channel, const Scaling &scaling, Time first, Time second);
    /// Forgets everything, also the store.
    void reset() { *this = CursorStatistics(); }
    /// Looks at so many rows, and tells whether that were all.
    bool advance(int mostRows);
    bool isComplete() const { return m_row >= m_end; }
    /// Of all rows that have been looked at.
    Result result() const;

    /// The value at a time (SignalStore::rowHoldingAt()), with gain and offset; NaN without one.
    static double valueAt(const SignalStore &store, int channel, const Scaling &scaling, Time time);

private:
    void take(Row row);

    const SignalStore *m_store = nullptr;
    int m_channel = 0;
    Scaling m_scaling;
    Time m_first = 0;
    Time m_second = 0;
    Row m_end = 0;
    Row m_row = 0;  // the next one

    // Sums of values minus the first one: differences of large numbers stay exact.
    std::int64_t m_count = 0;
    double m_shift = 0.0;
    double m_sum = 0.0;
    double m_squares = 0.0;
    double m_minimum = 0.0;
    double m_maximum = 0.0;
    double m_integral = 0.0;
    double m_last = NAN;  // value of the row before; NaN: none
    Time m_lastTime = 0;
};

}  // namespace qplc

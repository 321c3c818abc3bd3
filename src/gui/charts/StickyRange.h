// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// The range of an axis that follows what is seen, calmly: it grows at once, and shrinks only when
/// much less has been enough for a while. Ends are round numbers with a little room.
///
/// Knows no clock: it is told the time.
class StickyRange
{
public:
    using Time = std::int64_t;  // [ms], of any steady clock

    static constexpr Time patience = 2000;    // [ms]
    static constexpr double muchLess = 0.65;  // of the range at hand

    double minimum() const { return m_minimum; }
    double maximum() const { return m_maximum; }
    /// Takes what is seen; NaN: nothing, and nothing changes. \return whether the range is another
    /// one
    bool fit(double minimum, double maximum, Time now);
    /// What is seen next is taken as it is.
    void reset() { m_isFresh = true; }

private:
    bool take(double minimum, double maximum);

    double m_minimum = 0.0;
    double m_maximum = 1.0;
    bool m_isFresh = true;
    bool m_isTooLarge = false;
    Time m_tooLargeSince = 0;
};

}  // namespace qplc

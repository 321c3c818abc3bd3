// SPDX-License-Identifier: Apache-2.0
#include "StickyRange.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double room = 0.03;               // of what is seen, above and below
constexpr double roundSteps = 20.0;         // ends are multiples of a 20th of the range, rounded to 1, 2 or 5
constexpr double leastShareOfValue = 1e-6;  // a range of values of 32 bits is not smaller

double roundStep(double range)
{
    const double raw = range / roundSteps;
    const double decade = std::pow(10.0, std::floor(std::log10(raw)));
    const double factor = raw / decade;
    return decade * (factor <= 1.0 ? 1.0 : factor <= 2.0 ? 2.0 : factor <= 5.0 ? 5.0 : 10.0);
}

/// A constant gets a range of its own size.
double halfRangeOf(double constant)
{
    return constant == 0.0 ? 1.0 : 0.1 * std::abs(constant);
}

}  // namespace

bool StickyRange::fit(double minimum, double maximum, Time now)
{
    if (!(minimum <= maximum) || !std::isfinite(minimum) || !std::isfinite(maximum))
        return false;
    const double largest = std::max(std::abs(minimum), std::abs(maximum));
    if (maximum - minimum <= leastShareOfValue * largest) {
        const double middle = 0.5 * (minimum + maximum);
        const double half = halfRangeOf(middle);
        minimum = middle - half;
        maximum = middle + half;
    }
    const double margin = room * (maximum - minimum);
    const double step = roundStep(maximum - minimum);
    const double low = step * std::floor((minimum - margin) / step);
    const double high = step * std::ceil((maximum + margin) / step);
    if (m_isFresh)
        return take(low, high);
    if (minimum < m_minimum || maximum > m_maximum)
        return take(std::min(low, m_minimum), std::max(high, m_maximum));
    const bool isTooLarge = high - low < muchLess * (m_maximum - m_minimum);
    if (isTooLarge && !m_isTooLarge)
        m_tooLargeSince = now;
    m_isTooLarge = isTooLarge;
    return isTooLarge && now - m_tooLargeSince >= patience && take(low, high);
}

bool StickyRange::take(double minimum, double maximum)
{
    const bool isOther = minimum != m_minimum || maximum != m_maximum;
    m_minimum = minimum;
    m_maximum = maximum;
    m_isFresh = false;
    m_isTooLarge = false;
    return isOther;
}

}  // namespace qplc

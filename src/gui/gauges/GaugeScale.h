// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// From where to where a gauge goes, with round numbers. A value type.
struct GaugeScale
{
    double minimum = 0.0;
    double maximum = 1.0;

    double span() const { return maximum - minimum; }
    /// 0 ... 1 for values of the scale, clamped; 0 for NaN.
    double share(double value) const;
    /// At most \a most round numbers, with the ends where they are round.
    QVector<double> ticks(int most) const;
    /// So many digits that a thousandth of the scale is seen; 0 ... 6.
    int decimals() const;
    /// Grows to the next round number (1, 2, 5 x 10^n), to both sides of 0 where there are negative
    /// values, and never shrinks. \return whether it has grown
    bool extendTo(double value);

    friend bool operator==(const GaugeScale &a, const GaugeScale &b)
    {
        return a.minimum == b.minimum && a.maximum == b.maximum;
    }
    friend bool operator!=(const GaugeScale &a, const GaugeScale &b) { return !(a == b); }
};

/// A number of a gauge: so many decimals, but no more than five digits in all unless there are more
/// before the point, a real minus, "NaN" and "∞" as such; powers of ten beyond 10^7.
QString gaugeNumber(double value, int decimals);

}  // namespace qplc

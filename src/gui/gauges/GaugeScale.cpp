// SPDX-License-Identifier: Apache-2.0
#include "GaugeScale.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int mostDigits = 5;  // that anybody reads at a glance

/// The smallest 1, 2, 5 x 10^n that is not below \a value > 0.
double roundUp(double value)
{
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * power * (1.0 + 1e-9))
            return step * power;
    }
    return 10.0 * power;
}

}  // namespace

double GaugeScale::share(double value) const
{
    if (std::isnan(value) || !(span() > 0.0))
        return 0.0;
    return std::clamp((value - minimum) / span(), 0.0, 1.0);
}

QVector<double> GaugeScale::ticks(int most) const
{
    QVector<double> ticks;
    if (!(span() > 0.0) || !std::isfinite(span()) || most < 2)
        return ticks;
    const double step = roundUp(span() / double(most - 1));
    const double slack = 1e-6;  // a round end is not lost to rounding
    const double first = std::ceil(minimum / step - slack);
    for (double number = first; number * step <= maximum + slack * step; number += 1.0)
        ticks << number * step;
    return ticks;
}

int GaugeScale::decimals() const
{
    if (!(span() > 0.0) || !std::isfinite(span()))
        return 0;
    return std::clamp(int(std::ceil(-std::log10(span() / 1000.0) - 1e-9)), 0, 6);
}

bool GaugeScale::extendTo(double value)
{
    if (!std::isfinite(value) || (value >= minimum && value <= maximum))
        return false;
    const double reach = std::max(roundUp(std::abs(value)), maximum);
    minimum = value < 0.0 || minimum < 0.0 ? -reach : 0.0;
    maximum = reach;
    return true;
}

QString gaugeNumber(double value, int decimals)
{
    if (std::isnan(value))
        return QStringLiteral("NaN");
    const QString sign = value < 0.0 ? QStringLiteral("−") : QString();
    if (std::isinf(value))
        return sign + QStringLiteral("∞");
    const double size = std::abs(value);
    const int whole = size < 1.0 ? 1 : int(std::floor(std::log10(size))) + 1;
    decimals = std::clamp(mostDigits - whole, 0, decimals);
    const QString digits = size < 1e7 ? QString::number(size, 'f', decimals) : QString::number(size, 'e', 2);
    const bool isZero = size < 1e7 && digits.toDouble() == 0.0;
    return isZero ? digits : sign + digits;
}

}  // namespace qplc

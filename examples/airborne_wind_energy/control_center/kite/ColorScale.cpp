// SPDX-License-Identifier: Apache-2.0
#include "ColorScale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace awe {

namespace {

constexpr std::array<QRgb, 5> stops = {0xff6a5acd, 0xff2b8fc9, 0xff25a07a, 0xffc79a1b, 0xffe2592b};

int mixed(int a, int b, double share)
{
    return int(std::lround(a + (b - a) * share));
}

/// 1, 2 or 5 times a power of ten, not below \a width.
double roundStep(double width)
{
    const double power = std::pow(10.0, std::floor(std::log10(width)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= width * (1.0 - 1e-9))
            return factor * power;
    }
    return 10.0 * power;
}

}  // namespace

QColor ColorScale::color(double value) const
{
    if (std::isnan(value))
        return QColor(0xff8b939c);
    const double share = maximum > minimum ? std::clamp((value - minimum) / (maximum - minimum), 0.0, 1.0) : 0.5;
    const double place = share * double(stops.size() - 1);
    const std::size_t lower = std::min(std::size_t(place), stops.size() - 2);
    const QColor a(stops[lower]);
    const QColor b(stops[lower + 1]);
    const double rest = place - double(lower);
    return {mixed(a.red(), b.red(), rest), mixed(a.green(), b.green(), rest), mixed(a.blue(), b.blue(), rest)};
}

ColorScale ColorScale::around(double minimum, double maximum)
{
    if (!(minimum <= maximum) || !std::isfinite(minimum) || !std::isfinite(maximum))
        return {};
    if (maximum - minimum < 1e-9 * std::max(1.0, std::abs(maximum)))
        return {minimum - 0.5, maximum + 0.5};
    const double step = roundStep((maximum - minimum) / 4.0);
    return {std::floor(minimum / step) * step, std::ceil(maximum / step) * step};
}

}  // namespace awe

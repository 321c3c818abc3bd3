// SPDX-License-Identifier: Apache-2.0
#include "ValueRanges.h"

#include "PlotCurves.h"

#include <algorithm>
#include <cmath>

namespace qplc {

ValueRanges::ValueRanges(PlotCanvas *canvas, const PlotCurves *curves)
    : m_canvas(canvas)
    , m_curves(curves)
{
    m_clock.start();
}

void ValueRanges::bind()
{
    m_ranges.resize(std::size_t(m_curves->axes().count()));
    for (Axis axis = 0; axis < m_curves->axes().count(); ++axis) {
        if (at(axis).of == m_curves->axes().at(axis))
            continue;
        at(axis) = Range();
        at(axis).of = m_curves->axes().at(axis);
    }
}

void ValueRanges::reset()
{
    for (Range &range : m_ranges)
        range.automatic.reset();
}

void ValueRanges::release()
{
    for (Range &range : m_ranges)
        range.isHeld = false;
}

bool ValueRanges::fit()
{
    const double begin = double(m_canvas->begin() - m_canvas->origin()) * 1e-9;
    const double end = double(m_canvas->end() - m_canvas->origin()) * 1e-9;
    bool isOther = false;
    for (Axis axis = 0; axis < m_curves->axes().count(); ++axis) {
        const QPlcPast::Range values = m_curves->range(axis, begin, end);
        isOther = at(axis).automatic.fit(values.minimum, values.maximum, m_clock.elapsed()) || isOther;
    }
    return isOther;
}

void ValueRanges::show(const PlotSettings &settings)
{
    for (Axis axis = 0; axis < m_curves->axes().count(); ++axis)
        show(axis, settings.range(axis, m_curves->axes().at(axis).unit));
}

void ValueRanges::show(Axis axis, const PlotRangeSettings &wanted)
{
    const Range &range = at(axis);
    double minimum = wanted.minimum.value_or(range.automatic.minimum());
    double maximum = wanted.maximum.value_or(range.automatic.maximum());
    if (!(minimum < maximum)) {  // one end is given, and all that is seen is beyond it
        minimum = wanted.minimum ? *wanted.minimum : maximum - 1.0;
        maximum = wanted.minimum ? minimum + 1.0 : maximum;
    }
    if (range.isHeld) {
        minimum = range.minimum;
        maximum = range.maximum;
    } else if (m_curves->isWhole(axis) && !wanted.isFixed() && std::floor(maximum) - std::ceil(minimum) < 1.0) {
        minimum = std::floor(minimum);  // a constant has its neighbours
        maximum = std::ceil(maximum);
    }
    // What a person has chosen is that of the whole canvas.
    m_canvas->setRange(axis, minimum, maximum, m_curves->isWhole(axis) ? PlotCanvas::WholeTicks : PlotCanvas::AnyTicks,
                       range.isHeld ? 0.0 : m_curves->laneHeight());
}

/// Ends of a y axis, also of one that is not drawn yet: steps of a mouse come more often than
/// pictures.
std::pair<double, double> ValueRanges::seen(Axis axis) const
{
    const Range &range = m_ranges[std::size_t(axis)];
    if (range.isHeld)
        return {range.minimum, range.maximum};
    return {m_canvas->valueAt(axis, m_canvas->canvas()->height()), m_canvas->valueAt(axis, 0.0)};
}

void ValueRanges::zoom(Axis axis, double factor, double about)
{
    if (!m_curves->hasAxis(axis))
        return;
    const auto [low, high] = seen(axis);
    const double fixed = high - about / std::max(1, m_canvas->canvas()->height()) * (high - low);
    const double minimum = fixed + factor * (low - fixed);
    const double maximum = fixed + factor * (high - fixed);
    // Below, neighbours of 32-bit values are farther apart than pixels.
    if (!(maximum - minimum > 1e-9 * std::max(std::abs(minimum), std::abs(maximum)))
        || !std::isfinite(maximum - minimum))
        return;
    at(axis).isHeld = true;
    at(axis).minimum = minimum;
    at(axis).maximum = maximum;
}

void ValueRanges::pan(Axis axis, double by)
{
    if (!m_curves->hasAxis(axis))
        return;
    const auto [low, high] = seen(axis);
    const double shift = by / std::max(1, m_canvas->canvas()->height()) * (high - low);
    at(axis).isHeld = true;
    at(axis).minimum = low + shift;
    at(axis).maximum = high + shift;
}

void ValueRanges::zoomTo(const QRect &box)
{
    for (Axis axis = 0; axis < m_curves->axes().count(); ++axis) {
        Range &range = at(axis);
        range.minimum = m_canvas->valueAt(axis, box.bottom() + 1);
        range.maximum = m_canvas->valueAt(axis, box.top());
        range.isHeld = m_curves->hasAxis(axis) && range.minimum < range.maximum;
    }
}

}  // namespace qplc

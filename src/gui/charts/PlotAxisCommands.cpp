// SPDX-License-Identifier: Apache-2.0
// What a person can do with the y axes of a time plot: zoom, pan, choose, and draw lines across
// them.
#include "QPlcTimePlotPrivate.h"

#include <algorithm>
#include <cmath>

using namespace qplc;

namespace {

constexpr double firstOfRightAxis = 0.6;  // of the width of the panel: where signals are dropped for the right axis
constexpr double lastOfRightAxis = 0.88;

}  // namespace

void QPlcTimePlot::Private::zoomValues(Axis axis, double factor, double about)
{
    if (!curves.hasAxis(axis))
        return;
    const auto [low, high] = valuesOf(axis);
    const double fixed = high - about / std::max(1, canvas->canvas()->height()) * (high - low);
    ValueAxis &values = axes[std::size_t(axis)];
    const double minimum = fixed + factor * (low - fixed);
    const double maximum = fixed + factor * (high - fixed);
    // Below, neighbours of 32-bit values are farther apart than pixels.
    if (!(maximum - minimum > 1e-9 * std::max(std::abs(minimum), std::abs(maximum)))
        || !std::isfinite(maximum - minimum))
        return;
    values.isHeld = true;
    values.minimum = minimum;
    values.maximum = maximum;
    ++version;
    schedule();
}

void QPlcTimePlot::Private::panValues(Axis axis, double by)
{
    if (!curves.hasAxis(axis))
        return;
    const auto [low, high] = valuesOf(axis);
    const double shift = by / std::max(1, canvas->canvas()->height()) * (high - low);
    ValueAxis &values = axes[std::size_t(axis)];
    values.minimum = low + shift;
    values.maximum = high + shift;
    values.isHeld = true;
    ++version;
    schedule();
}

/// Ends of a y axis, also of one that is not drawn yet: steps of a mouse come more often than
/// pictures.
std::pair<double, double> QPlcTimePlot::Private::valuesOf(Axis axis) const
{
    const ValueAxis &values = axes[std::size_t(axis)];
    if (values.isHeld)
        return {values.minimum, values.maximum};
    return {canvas->valueAt(axis, canvas->canvas()->height()), canvas->valueAt(axis, 0.0)};
}

/// The chosen curve goes to the other side, where its unit has an axis.
void QPlcTimePlot::Private::toggleRightAxis()
{
    const PlotCurve *curve = chosenCurve();
    if (!curve || curve->isDrawnAsBands())
        return;
    const bool isRight = curves.axes().at(curve->axis).side == PlotCurveSettings::Right;
    PlotSettings wanted = settings;
    for (PlotCurveSettings &each : wanted.curves) {
        if (each.signal == curve->settings.signal)
            each.axis = isRight ? PlotCurveSettings::Left : PlotCurveSettings::Right;
    }
    edit(wanted);
}

/// Also curves that are there already.
bool QPlcTimePlot::Private::addToRightAxis(const QStringList &references)
{
    PlotSettings wanted = settings;
    QStringList names;
    for (const QString &signal : references)
        names << elementsOf(signal);
    for (const QString &name : qAsConst(names)) {
        if (wanted.indexOf(name) < 0) {
            PlotCurveSettings curve;
            curve.signal = name;
            wanted.curves.append(curve);
        }
    }
    for (PlotCurveSettings &each : wanted.curves) {
        if (names.contains(each.signal))
            each.axis = PlotCurveSettings::Right;
    }
    if (names.isEmpty())
        return false;
    edit(wanted);
    select(wanted.indexOf(names.last()));
    return true;
}

/// Where signals are dropped that are to have an axis at the right [px of the panel]; null: where
/// there is nothing else, they have the left one.
QRect QPlcTimePlot::Private::rightAxisArea() const
{
    if (curves.isEmpty())
        return {};
    const QRect middle(int(firstOfRightAxis * q->width()), q->height() / 4,
                       int((lastOfRightAxis - firstOfRightAxis) * q->width()), q->height() / 2);
    return middle & canvas->geometry();
}

bool QPlcTimePlot::Private::hasLines() const
{
    const auto hasSome = [](const PlotRangeSettings &range) { return !range.lines.isEmpty(); };
    return hasSome(settings.left) || hasSome(settings.right)
        || std::any_of(settings.axes.begin(), settings.axes.end(), hasSome);
}

/// At the mouse, or in the middle; a value with as many digits as pixels tell apart.
void QPlcTimePlot::Private::addLine()
{
    if (curves.isEmpty())
        return;
    Axis axis = 0;
    while (axis + 1 < curves.axes().count() && !curves.hasAxis(axis))
        ++axis;
    const double y = interaction->mouse() ? interaction->mouse()->y() : 0.5 * canvas->canvas()->height();
    const double value = canvas->valueAt(axis, y);
    const double pixel = std::abs(canvas->valueAt(axis, y + 1.0) - value);
    const int digits = std::clamp(int(std::ceil(std::log10(std::abs(value) / pixel))), 1, 7);
    PlotSettings wanted = settings;
    QVector<double> &lines = wanted.range(axis, curves.axes().at(axis).unit).lines;
    lines.append(QString::number(value, 'g', digits).toDouble());
    edit(wanted);
}

void QPlcTimePlot::Private::removeLines()
{
    if (!hasLines())
        return;
    PlotSettings wanted = settings;
    wanted.left.lines.clear();
    wanted.right.lines.clear();
    for (PlotRangeSettings &range : wanted.axes)
        range.lines.clear();
    edit(wanted);
}

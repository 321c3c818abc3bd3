// SPDX-License-Identifier: Apache-2.0
#include "PlotScales.h"

#include <qwt_scale_map.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double largestPlain = 1e6;
constexpr int mostPlainDecimals = 5;
constexpr int lengthOfTick = 4;  // [px]

void setTicksShort(QwtScaleDraw *draw)
{
    draw->setTickLength(QwtScaleDiv::MajorTick, lengthOfTick);
    draw->setTickLength(QwtScaleDiv::MediumTick, lengthOfTick - 1);
    draw->setTickLength(QwtScaleDiv::MinorTick, lengthOfTick - 2);
    draw->enableComponent(QwtAbstractScaleDraw::Backbone, false);
}

double stepOf(const QList<double> &ticks)
{
    return ticks.size() > 1 ? std::abs(ticks[1] - ticks[0]) : 1.0;
}

/// Digits behind the point with which ticks are what they say.
int decimalsOf(const QList<double> &ticks)
{
    constexpr int most = 12;
    const double tolerance = 1e-3 * stepOf(ticks);
    for (int decimals = 0; decimals < most; ++decimals) {
        const double unit = std::pow(10.0, -decimals);
        const auto isMultiple
            = [=](double tick) { return std::abs(tick - unit * std::round(tick / unit)) < tolerance; };
        if (std::all_of(ticks.begin(), ticks.end(), isMultiple))
            return decimals;
    }
    return most;
}

/// As many digits as ticks need, without an exponent where that is possible.
QString tickText(double value, double factor, const QwtScaleDiv &scale)
{
    QList<double> ticks = scale.ticks(QwtScaleDiv::MajorTick);
    for (double &tick : ticks)
        tick *= factor;
    value *= factor;
    const double step = stepOf(ticks);
    if (std::abs(value) < 1e-6 * step)
        return QStringLiteral("0");
    const double largest = factor * std::max(std::abs(scale.lowerBound()), std::abs(scale.upperBound()));
    const int decimals = decimalsOf(ticks);
    if (largest < largestPlain && decimals <= mostPlainDecimals)
        return QString::number(value, 'f', decimals);
    const int digits = int(std::floor(std::log10(std::abs(value)) + 1e-9) - std::floor(std::log10(step) + 1e-9));
    return QString::number(value, 'e', std::clamp(digits, 0, 9));
}

constexpr double easyDistance = 2.2;      // labels from one to the next, in labels
constexpr double closestDistance = 1.05;  // where few labels have room
constexpr int enoughLabels = 3;
constexpr int fewestLabels = 2;

/// Multiples of a step.
struct Multiples
{
    Multiples(double minimum, double maximum, double wantedStep)
        : step(wantedStep)
        , first(std::ceil(minimum / step - 1e-6))
        , last(std::floor(maximum / step + 1e-6))
    {
    }
    double count() const { return last - first + 1.0; }
    double step;
    double first;
    double last;
};

/// The largest of 1, 2 and 5 times a power of ten that is below \a step.
double finerStep(double step)
{
    const double decade = std::pow(10.0, std::floor(std::log10(step) + 1e-6));
    const double lead = step / decade;
    return lead > 4.9 ? 2.0 * decade : lead > 1.9 ? decade : 0.5 * decade;
}

QList<double> ticksOf(const Multiples &multiples)
{
    QList<double> ticks;
    for (double i = multiples.first; i <= multiples.last; ++i)
        ticks.append(i * multiples.step);
    return ticks;
}

}  // namespace

QwtScaleDiv valueScale(double minimum, double maximum, double room, double label, double step)
{
    const double range = maximum - minimum;
    if (!(range > 0.0) || !std::isfinite(range))
        return QwtScaleDiv(minimum, maximum);
    const auto labelsApart = [&](double wanted) { return wanted / range * room / std::max(label, 1.0); };
    Multiples found(minimum, maximum, finerStep(20.0 * std::pow(10.0, std::ceil(std::log10(range)))));
    const auto isFinerAllowed = [&] { return step <= 0.0 || finerStep(found.step) > step * 0.999; };
    const auto makeFiner = [&] { found = Multiples(minimum, maximum, finerStep(found.step)); };
    while (isFinerAllowed() && labelsApart(finerStep(found.step)) >= easyDistance)
        makeFiner();
    while (found.count() < enoughLabels && isFinerAllowed() && labelsApart(finerStep(found.step)) >= closestDistance)
        makeFiner();
    while (found.count() < fewestLabels)  // also between whole numbers, when nobody sees two of them
        makeFiner();
    QList<double> major = ticksOf(found);
    if (major.size() > fewestLabels && labelsApart(found.step) < closestDistance)
        major = {major.first(), major.last()};
    const Multiples minor(minimum, maximum, found.step / 5.0);
    const bool hasMinor = step <= 0.0 && labelsApart(found.step) >= closestDistance;
    return QwtScaleDiv(minimum, maximum, hasMinor ? ticksOf(minor) : QList<double>(), {}, major);
}

ValueScaleDraw::ValueScaleDraw(const QFont &font, int characters)
    : m_metrics(font)
    , m_room(m_metrics.horizontalAdvance(QLatin1Char('8')) * characters)
{
    setTicksShort(this);
    setMinimumExtent(m_room + lengthOfTick + spacing());
}

void ValueScaleDraw::setNames(const QPlcValueNames &names)
{
    m_names = names;
    invalidateCache();
}

void ValueScaleDraw::setFactor(double factor)
{
    if (factor == m_factor)
        return;
    m_factor = factor;
    invalidateCache();
}

QwtText ValueScaleDraw::label(double value) const
{
    const bool isWhole = std::abs(value - std::round(value)) < 1e-6;
    const QString name = m_names.isEmpty() || !isWhole ? QString() : m_names.nameOf(std::llround(value));
    if (!name.isEmpty())
        return QwtText(m_metrics.elidedText(name, Qt::ElideRight, m_room), QwtText::PlainText);
    return tickText(value, m_factor, scaleDiv());
}

TimeScaleDraw::TimeScaleDraw(const QFont &font, bool isCompact)
    : m_metrics(font)
    , m_isCompact(isCompact)
{
    setTicksShort(this);
}

void TimeScaleDraw::setTicks(const TimeTicks &ticks, Time origin)
{
    m_ticks = ticks;
    m_origin = origin;
    invalidateCache();
}

int TimeScaleDraw::sideRoom() const
{
    if (m_isCompact)
        return 2;
    return int(std::ceil(0.5 * m_metrics.horizontalAdvance(QStringLiteral("00:00:00")))) + 2;
}

double TimeScaleDraw::usualWidth() const
{
    return m_metrics.horizontalAdvance(QStringLiteral("00:00:00.0"));
}

QwtText TimeScaleDraw::label(double value) const
{
    const Time time = m_origin + std::llround(value * 1e9);
    const QString text = m_ticks.label(time);
    const double position = scaleMap().transform(value);
    const double room = std::min(position - scaleMap().p1(), scaleMap().p2() - position) + sideRoom();
    return 0.5 * m_metrics.horizontalAdvance(text) <= room ? QwtText(text) : QwtText();
}

}  // namespace qplc

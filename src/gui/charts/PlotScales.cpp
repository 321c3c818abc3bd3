// SPDX-License-Identifier: Apache-2.0
#include "PlotScales.h"

#include <qwt_scale_map.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double largestPlain = 1e6;
constexpr double smallestPlainStep = 1e-4;
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

}  // namespace

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

QwtText ValueScaleDraw::label(double value) const
{
    const QString name = m_names.isEmpty() ? QString() : m_names.nameOf(std::llround(value));
    if (!name.isEmpty())
        return QwtText(m_metrics.elidedText(name, Qt::ElideRight, m_room), QwtText::PlainText);
    const double step = stepOf(scaleDiv().ticks(QwtScaleDiv::MajorTick));
    if (std::abs(value) < 1e-6 * step)
        return QStringLiteral("0");
    const double largest = std::max(std::abs(scaleDiv().lowerBound()), std::abs(scaleDiv().upperBound()));
    if (largest >= largestPlain || step < smallestPlainStep)
        return QString::number(value, 'g', 4);
    const int decimals = std::max(0, int(std::ceil(-std::log10(step) - 1e-6)));
    return QString::number(value, 'f', decimals);
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

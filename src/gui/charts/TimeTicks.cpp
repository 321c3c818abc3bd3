// SPDX-License-Identifier: Apache-2.0
#include "TimeTicks.h"

#include <QtCore/QDateTime>
#include <QtCore/QLocale>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

using Time = TimeTicks::Time;

constexpr Time second = 1'000'000'000;
constexpr Time minute = 60 * second;
constexpr Time hour = 60 * minute;
constexpr Time longSteps[]
    = {second,      2 * second,  5 * second,  10 * second, 15 * second, 30 * second, minute,   2 * minute, 5 * minute,
       10 * minute, 15 * minute, 30 * minute, hour,        2 * hour,    3 * hour,    6 * hour, 12 * hour,  24 * hour};

Time floorOf(Time time, Time step)
{
    const Time quotient = time / step - (time % step < 0 ? 1 : 0);
    return quotient * step;
}

/// Digits behind the point with which multiples of a step are written.
int digitsOf(Time step)
{
    int digits = 0;
    for (Time unit = second; unit > 1 && step % unit != 0; unit /= 10)
        ++digits;
    return digits;
}

int minorsOf(Time step)
{
    Time lead = step;
    while (lead >= 10 && lead % 10 == 0)
        lead /= 10;
    return lead % 3 == 0 ? 3 : lead == 2 ? 4 : 5;
}

}  // namespace

Time beginOfDay(Time time)
{
    const QDateTime moment = QDateTime::fromMSecsSinceEpoch(floorOf(time, 1'000'000) / 1'000'000);
    return QDateTime(moment.date(), QTime(0, 0)).toMSecsSinceEpoch() * 1'000'000;
}

TimeTicks::TimeTicks(Time begin, Time end, int widest)
    : m_hasDates(end - begin > 24 * hour)
    , m_step(stepFor(end - begin, widest))
{
    place(begin, end, beginOfDay(begin));
}

TimeTicks::TimeTicks(Time begin, Time end, int widest, Time reference)
    : m_isRelative(true)
    , m_reference(reference)
    , m_step(stepFor(end - begin, widest))
{
    place(begin, end, reference);
}

TimeTicks TimeTicks::aroundEvent(Time begin, Time end, int widest, Time event)
{
    TimeTicks ticks(begin, end, widest, event);
    ticks.m_hasUnits = true;
    return ticks;
}

/// The smallest round step with at most so many labels.
Time TimeTicks::stepFor(Time span, int widest)
{
    const Time least = std::max<Time>(span / std::max(widest, 1), 1);
    for (Time decade = 1; decade < second; decade *= 10) {
        for (const Time factor : {1, 2, 5}) {
            if (factor * decade >= least)
                return factor * decade;
        }
    }
    for (const Time step : longSteps) {
        if (step >= least)
            return step;
    }
    return floorOf(least + 24 * hour - 1, 24 * hour);
}

void TimeTicks::place(Time begin, Time end, Time zero)
{
    const int parts = minorsOf(m_step);
    for (Time tick = zero + floorOf(begin - zero, m_step); tick <= end; tick += m_step) {
        if (tick >= begin)
            m_major.append(tick);
        for (int part = 1; part < parts; ++part) {
            const Time minor = tick + m_step * part / parts;
            if (minor >= begin && minor <= end)
                m_minor.append(minor);
        }
    }
}

QString TimeTicks::label(Time time) const
{
    if (!m_isRelative && m_hasDates && (m_step >= 24 * hour || time == beginOfDay(time))) {
        const Time noon = time + (m_step >= 24 * hour ? 12 * hour : 0);  // of the day, whatever the clocks do
        return QLocale::c().toString(QDateTime::fromSecsSinceEpoch(noon / second).date(), QStringLiteral("d MMM"));
    }
    if (!m_isRelative)
        return clockText(time, m_step);
    const Time after = time - m_reference;
    if (!m_hasUnits)
        return QString::number(double(after) * 1e-9, 'f', digitsOf(m_step));
    if (after == 0)
        return QStringLiteral("0");
    if (m_step >= 10 * second)
        return QStringLiteral("%1 s").arg(after / second);
    return QStringLiteral("%1 ms").arg(double(after) * 1e-6, 0, 'f', std::max(0, digitsOf(m_step) - 3));
}

QString TimeTicks::clockText(Time time, Time resolution)
{
    const Time whole = floorOf(time, second);
    const QTime clock = QDateTime::fromSecsSinceEpoch(whole / second).time();
    if (resolution >= minute && resolution % minute == 0)
        return clock.toString(QStringLiteral("HH:mm"));
    const QString text = clock.toString(QStringLiteral("HH:mm:ss"));
    const int digits = digitsOf(std::max<Time>(resolution, 1));
    if (digits == 0)
        return text;
    const QString fraction = QStringLiteral("%1").arg(time - whole, 9, 10, QLatin1Char('0'));
    return text + QLatin1Char('.') + fraction.left(digits);
}

}  // namespace qplc

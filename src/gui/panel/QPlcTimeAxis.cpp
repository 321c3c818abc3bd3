// SPDX-License-Identifier: Apache-2.0
#include "QPlcTimeAxis.h"

#include <cmath>

void QPlcTimeAxis::setSpan(Time span)
{
    change(m_isLive, end(), span);
}

void QPlcTimeAxis::show(Time begin, Time end)
{
    change(false, end, end - begin);
}

void QPlcTimeAxis::zoom(double factor, Time about)
{
    // These also give NaN a place in the range.
    const Time span = Time(std::fmax(std::fmin(double(m_span) * factor, double(longestSpan)), double(shortestSpan)));
    const double share = double(end() - about) / double(m_span);
    change(m_isLive && about >= end(), about + Time(std::llround(share * double(span))), span);
}

void QPlcTimeAxis::pan(Time by)
{
    change(false, end() + by, m_span);
}

void QPlcTimeAxis::freeze()
{
    change(false, end(), m_span);
}

void QPlcTimeAxis::goLive()
{
    change(true, m_newest, m_span);
}

void QPlcTimeAxis::jumpTo(Time time)
{
    change(false, time + m_span / 2, m_span);
}

void QPlcTimeAxis::setCursor(Cursor which, std::optional<Time> time)
{
    if (time == m_cursors[which])
        return;
    m_cursors[which] = time;
    Q_EMIT cursorsChanged();
}

void QPlcTimeAxis::setPointer(std::optional<Time> time)
{
    if (time == m_pointer)
        return;
    m_pointer = time;
    Q_EMIT pointerChanged();
    if (!m_isLive)
        Q_EMIT displayTimeChanged();
}

void QPlcTimeAxis::setPlayhead(std::optional<Time> time)
{
    if (time == m_playhead)
        return;
    const std::optional<Time> before = displayTime();
    m_playhead = time;
    if (time) {
        // A playhead that runs out of the picture goes on near the left edge of the next one.
        const bool isSeen = *time >= begin() && *time <= end();
        change(false, isSeen ? end() : *time + m_span - m_span / 16, m_span);
    }
    Q_EMIT playheadChanged();
    if (displayTime() != before)
        Q_EMIT displayTimeChanged();
}

std::optional<QPlcTimeAxis::Time> QPlcTimeAxis::displayTime() const
{
    if (m_isLive)
        return std::nullopt;
    const Time wanted = m_pointer.value_or(m_playhead.value_or(m_end));
    const bool hasValues = m_newest > 0;  // before, what is looked at is an event of the log, say
    return hasValues ? std::min(wanted, m_newest) : wanted;
}

void QPlcTimeAxis::setNewest(Time time)
{
    const std::optional<Time> before = displayTime();
    m_newest = time;
    if (displayTime() != before)  // a frozen view that reaches into the future
        Q_EMIT displayTimeChanged();
}

void QPlcTimeAxis::change(bool isLive, Time end, Time span)
{
    const Time allowedSpan = std::clamp(span, shortestSpan, longestSpan);
    if (isLive == m_isLive && allowedSpan == m_span && (isLive || end == m_end))
        return;
    const std::optional<Time> before = displayTime();
    const bool comesBack = isLive && !m_isLive;
    m_isLive = isLive;
    m_end = end;
    m_span = allowedSpan;
    if (comesBack)
        setPointer(std::nullopt);  // that of an event, say; a mouse points again
    Q_EMIT viewChanged();
    if (displayTime() != before)
        Q_EMIT displayTimeChanged();
}

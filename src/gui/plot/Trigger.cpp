// SPDX-License-Identifier: Apache-2.0
#include "Trigger.h"

#include <algorithm>
#include <cmath>

namespace qplc {

using Time = SignalStore::Time;

namespace {

Time nanoseconds(double seconds)
{
    constexpr double longest = 9e9;  // [s], so that the number is one of 64 bits
    return Time(std::llround(std::clamp(seconds, 0.0, longest) * 1e9));
}

}  // namespace

void Trigger::setSettings(const Settings &settings)
{
    m_settings = settings;
    m_wasBelow = m_wasAbove = m_wasOutside = m_wasInside = false;
}

void Trigger::arm()
{
    m_state = Armed;
    m_count = 0;
    m_events.clear();
    m_shown.reset();
    m_next.reset();
    m_last.reset();
    m_waitsSince.reset();
    m_wasBelow = m_wasAbove = m_wasOutside = m_wasInside = false;
}

bool Trigger::take(const SignalStore &store, int channel)
{
    const State stateBefore = m_state;
    const std::uint64_t countBefore = m_count;
    const SignalStore::Row first = std::max(m_next.value_or(store.endRow()), store.firstRow());
    if (m_next && first > *m_next)
        m_last.reset();  // rows have gone that nobody looked at
    for (SignalStore::Row row = first; row < store.endRow(); ++row) {
        if (store.beginsAnew(row))
            m_last.reset();
        look({store.time(row), double(store.value(channel, row))});
    }
    m_next = store.endRow();
    return m_state != stateBefore || m_count != countBefore;
}

void Trigger::look(Row row)
{
    passTime(row.time);
    if (std::isnan(row.value)) {
        m_last.reset();
        return;
    }
    if (!m_last)  // nothing is known of what was before
        m_wasBelow = m_wasAbove = m_wasOutside = m_wasInside = false;
    const std::optional<double> level = crossedLevel(row.value);
    if (level && m_state != Done)
        addEvent(timeOfLevel(row, *level));
    m_last = row;
}

/// The level that makes an event of this value. Notes what is to be known for the next one.
std::optional<double> Trigger::crossedLevel(double value)
{
    const Settings &s = m_settings;
    std::optional<double> level;
    const bool rises = m_wasBelow && value >= s.level;
    const bool falls = m_wasAbove && value <= s.level;
    const bool mayRise = s.kind == RisingEdge || s.kind == EitherEdge;
    const bool mayFall = s.kind == FallingEdge || s.kind == EitherEdge;
    if ((mayRise && rises) || (mayFall && falls) || (s.kind == AboveLevel && value >= s.level)
        || (s.kind == BelowLevel && value <= s.level))
        level = s.level;
    if (s.kind == EntersWindow && m_wasOutside && isInside(value, 0.0))
        level = borderTowards(m_last->value);
    if (s.kind == LeavesWindow && m_wasInside && !isInside(value, 0.0))
        level = borderTowards(value);
    m_wasBelow = (m_wasBelow && !rises) || value < s.level - s.hysteresis;
    m_wasAbove = (m_wasAbove && !falls) || value > s.level + s.hysteresis;
    m_wasOutside = (m_wasOutside && !isInside(value, 0.0)) || !isInside(value, s.hysteresis);
    m_wasInside = (m_wasInside && isInside(value, 0.0)) || isInside(value, -s.hysteresis);
    return level;
}

/// Whether a value is in the window, made wider by \a margin at both ends.
bool Trigger::isInside(double value, double margin) const
{
    const double low = std::min(m_settings.level, m_settings.upperLevel);
    const double high = std::max(m_settings.level, m_settings.upperLevel);
    return value >= low - margin && value <= high + margin;
}

/// The border of the window on the side of a value outside of it.
double Trigger::borderTowards(double value) const
{
    const double low = std::min(m_settings.level, m_settings.upperLevel);
    const double high = std::max(m_settings.level, m_settings.upperLevel);
    return value < low ? low : high;
}

/// When the line from the row before met the level.
Time Trigger::timeOfLevel(Row row, double level) const
{
    if (!m_last || m_last->value == row.value)
        return row.time;
    const double share = std::clamp((row.value - level) / (row.value - m_last->value), 0.0, 1.0);
    const bool wasMet = (m_last->value - level) * (row.value - level) > 0.0;
    return wasMet ? row.time : row.time - Time(std::llround(share * double(row.time - m_last->time)));
}

void Trigger::addEvent(Time time)
{
    if (!m_events.empty() && time < m_events.back() + std::max<Time>(nanoseconds(m_settings.holdOff), 1))
        return;
    ++m_count;
    if (m_events.size() == mostEvents)
        m_events.erase(m_events.begin());
    m_events.push_back(time);
    if (m_state == Triggered)
        return;  // what is shown is not complete yet
    m_shown = time;
    m_state = Triggered;
}

/// What ends by time alone.
void Trigger::passTime(Time now)
{
    if (m_state == Triggered && now >= *m_shown - pre() + m_span) {
        m_state = m_settings.mode == Single ? Done : Armed;
        m_waitsSince = now;
    }
    if (!m_waitsSince)
        m_waitsSince = now;
    if (m_state == Armed && m_settings.mode == Auto && now - *m_waitsSince >= freeRunAfter())
        m_state = FreeRunning;
    if (m_state == FreeRunning && m_settings.mode != Auto)
        m_state = Armed;
}

/// As long as the view, but not so short that it flickers.
Time Trigger::freeRunAfter() const
{
    constexpr Time shortest = 500'000'000;
    return std::max(m_span, shortest);
}

Time Trigger::pre() const
{
    return Time(std::llround(std::clamp(m_settings.preShare, 0.0, 1.0) * double(m_span)));
}

std::optional<Trigger::View> Trigger::view() const
{
    if (!m_shown || m_state == FreeRunning)
        return std::nullopt;
    return View{*m_shown - pre(), *m_shown - pre() + m_span};
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "EventLog.h"

#include <algorithm>

namespace qplc {

QString severityName(PlantEvent::Severity severity)
{
    switch (severity) {
    case PlantEvent::Info:
        return QStringLiteral("info");
    case PlantEvent::Warning:
        return QStringLiteral("warning");
    case PlantEvent::Error:
        return QStringLiteral("error");
    }
    return {};
}

QString kindName(PlantEvent::Kind kind)
{
    switch (kind) {
    case PlantEvent::State:
        return QStringLiteral("state");
    case PlantEvent::Node:
        return QStringLiteral("node");
    case PlantEvent::Late:
        return QStringLiteral("late");
    case PlantEvent::Fault:
        return QStringLiteral("fault");
    case PlantEvent::Set:
        return QStringLiteral("set");
    case PlantEvent::Lease:
        return QStringLiteral("lease");
    case PlantEvent::Overrun:
        return QStringLiteral("overrun");
    }
    return {};
}

void EventLog::append(PlantEvent event, std::int64_t time)
{
    if (event.text.size() > LongestText)
        event.text = event.text.left(LongestText - 1) + QChar(0x2026);
    event.sequence = ++m_newest;
    event.time = time;
    m_events.push_back(std::move(event));
    if (m_events.size() > Capacity)
        m_events.pop_front();
}

std::vector<PlantEvent> EventLog::after(quint64 sequence, std::size_t most) const
{
    const auto isNewer = [sequence](const PlantEvent &event) { return event.sequence > sequence; };
    const auto first = std::find_if(m_events.begin(), m_events.end(), isNewer);
    const auto count = std::min<std::ptrdiff_t>(std::ptrdiff_t(most), m_events.end() - first);
    return {first, first + count};
}

}  // namespace qplc

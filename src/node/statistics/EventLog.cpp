// SPDX-License-Identifier: Apache-2.0
#include "EventLog.h"

#include "protocol/messages/Events.h"

#include <algorithm>

namespace qplc {

static_assert(int(JournalEvent::Info) == int(messages::Severity::Info)
              && int(JournalEvent::Warning) == int(messages::Severity::Warning)
              && int(JournalEvent::Error) == int(messages::Severity::Error));

QString severityName(JournalEvent::Severity severity)
{
    return QLatin1String(messages::nameOf(messages::Severity(severity)));
}

QString kindName(JournalEvent::Kind kind)
{
    switch (kind) {
    case JournalEvent::State:
        return messages::stateEvent;
    case JournalEvent::Node:
        return QStringLiteral("node");
    case JournalEvent::Late:
        return QStringLiteral("late");
    case JournalEvent::Fault:
        return QStringLiteral("fault");
    case JournalEvent::Set:
        return QStringLiteral("set");
    case JournalEvent::Lease:
        return QStringLiteral("lease");
    case JournalEvent::Overrun:
        return QStringLiteral("overrun");
    case JournalEvent::Security:
        return QStringLiteral("security");
    case JournalEvent::Quality:
        return QStringLiteral("quality");
    case JournalEvent::Note:
        return messages::noteEvent;
    case JournalEvent::Report:
        return QStringLiteral("report");
    }
    return {};
}

messages::EventEntry toEntry(const JournalEvent &event)
{
    messages::EventEntry entry;
    entry.sequence = event.sequence;
    entry.time = quint64(event.time);
    entry.severity = severityName(event.severity);
    entry.kind = kindName(event.kind);
    entry.source = event.source;
    entry.text = event.text;
    entry.alarm = event.alarm;
    if (!event.alarm.isEmpty())
        entry.active = event.isActive;
    return entry;
}

void EventLog::append(JournalEvent event, std::int64_t time, std::int64_t monotonic)
{
    if (event.text.size() > LongestText)
        event.text = event.text.left(LongestText - 1) + QChar(0x2026);
    event.source.truncate(LongestSource);
    event.sequence = ++m_newest;
    event.time = time;
    event.monotonic = monotonic;
    m_events.push_back(std::move(event));
    if (m_events.size() > Capacity)
        m_events.pop_front();
}

std::vector<JournalEvent> EventLog::after(quint64 sequence, std::size_t most) const
{
    const quint64 before = m_newest - m_events.size();  // numbers have no gaps
    const auto first = m_events.begin() + std::ptrdiff_t(std::clamp(sequence, before, m_newest) - before);
    const auto count = std::min<std::ptrdiff_t>(std::ptrdiff_t(most), m_events.end() - first);
    return {first, first + count};
}

}  // namespace qplc

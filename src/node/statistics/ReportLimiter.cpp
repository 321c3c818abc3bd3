// SPDX-License-Identifier: Apache-2.0
#include "ReportLimiter.h"

namespace qplc {

std::optional<JournalEvent> ReportLimiter::report(const QString &thing, const QString &begin, const JournalEvent &event,
                                                  std::int64_t now)
{
    const auto [place, isNew] = m_things.try_emplace(thing);
    Thing &known = place->second;
    if (known.untold++ == 0)
        known.begin = begin;
    known.event = event;
    if (!isNew && now < known.quietUntil)
        return std::nullopt;
    if (!isNew)
        m_ends.erase({known.quietUntil, thing});
    beQuiet(*place, now);
    return tell(&known);
}

std::vector<JournalEvent> ReportLimiter::takeDue(std::int64_t now)
{
    std::vector<JournalEvent> due;
    while (!m_ends.empty() && m_ends.begin()->first <= now) {
        const auto thing = m_things.find(m_ends.begin()->second);
        m_ends.erase(m_ends.begin());
        if (thing->second.untold == 0) {
            m_things.erase(thing);
        } else {
            beQuiet(*thing, now);
            due.push_back(tell(&thing->second));
        }
    }
    return due;
}

std::optional<JournalEvent> ReportLimiter::take(const QString &thing)
{
    const auto known = m_things.find(thing);
    if (known == m_things.end() || known->second.untold == 0)
        return std::nullopt;
    return tell(&known->second);
}

std::optional<std::int64_t> ReportLimiter::nextDue() const
{
    return m_ends.empty() ? std::nullopt : std::make_optional(m_ends.begin()->first);
}

void ReportLimiter::beQuiet(Things::reference thing, std::int64_t now)
{
    thing.second.quietUntil = now + Pause;
    m_ends.emplace(thing.second.quietUntil, thing.first);
}

JournalEvent ReportLimiter::tell(Thing *thing)
{
    JournalEvent event = thing->event;
    event.text.prepend(thing->begin);
    if (thing->untold > 1)
        event.text += QStringLiteral(" (and %1 more since the last report)").arg(thing->untold - 1);
    thing->untold = 0;
    return event;
}

}  // namespace qplc

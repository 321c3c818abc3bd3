// SPDX-License-Identifier: Apache-2.0
#include "ReportLimiter.h"

namespace qplc {

std::optional<JournalEvent> ReportLimiter::report(const QString &thing, const QString &begin, const JournalEvent &event,
                                                  std::int64_t now)
{
    Thing &known = m_things[thing];
    if (known.untold++ == 0)
        known.begin = begin;
    known.event = event;
    if (now < known.quietUntil)
        return std::nullopt;
    known.quietUntil = now + Pause;
    return tell(&known);
}

std::vector<JournalEvent> ReportLimiter::takeDue(std::int64_t now)
{
    std::vector<JournalEvent> due;
    for (auto thing = m_things.begin(); thing != m_things.end();) {
        Thing &known = thing->second;
        const bool isQuiet = known.untold == 0;
        if (now < known.quietUntil) {
            ++thing;
        } else if (isQuiet) {
            thing = m_things.erase(thing);
        } else {
            known.quietUntil = now + Pause;
            due.push_back(tell(&known));
            ++thing;
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
    std::optional<std::int64_t> next;
    for (const auto &[name, thing] : m_things) {
        if (!next || thing.quietUntil < *next)
            next = thing.quietUntil;
    }
    return next;
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventLog.h"

#include <map>
#include <optional>
#include <set>
#include <utility>

namespace qplc {

/// Keeps what happens again and again from flooding a log: the first report of a thing is told at
/// once, further ones at most once a second, together, with their number. Looks at no clock. Times
/// are ns on any steady clock.
class ReportLimiter
{
public:
    static constexpr std::int64_t Pause = 1'000'000'000;  // [ns]

    /// \param thing  what has happened; reports of one thing are told together
    /// \param event the text of which begins with \a begin; of reports that are told together the
    ///         begin of the first and the rest of the last are told
    /// \return what is to be told now
    std::optional<JournalEvent> report(const QString &thing, const QString &begin, const JournalEvent &event,
                                       std::int64_t now);
    /// What is to be told at \a now.
    std::vector<JournalEvent> takeDue(std::int64_t now);
    /// What was not told yet about \a thing, whatever the time.
    std::optional<JournalEvent> take(const QString &thing);
    /// When takeDue() has something to do; none: nothing is under way.
    std::optional<std::int64_t> nextDue() const;

private:
    struct Thing
    {
        std::int64_t quietUntil = 0;
        quint64 untold = 0;
        QString begin;       // of the first one that was not told
        JournalEvent event;  // the last one, its text without the begin
    };
    using Things = std::map<QString, Thing>;

    void beQuiet(Things::reference thing, std::int64_t now);
    static JournalEvent tell(Thing *thing);

    Things m_things;                                    // told within the last second, or not told yet
    std::set<std::pair<std::int64_t, QString>> m_ends;  // of all pauses: one message may set thousands of signals
};

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <cstdint>
#include <deque>
#include <vector>

namespace qplc {

namespace messages {
struct EventEntry;
}

/// What happened at a master, as people want to know it.
struct JournalEvent
{
    enum Severity : std::uint8_t { Info, Warning, Error };  // as messages::Severity
    enum Kind : std::uint8_t { State, Node, Late, Fault, Set, Lease, Overrun, Security, Quality, Note, Report };

    Severity severity = Info;
    Kind kind = State;
    QString source;  // name of a node, or of the master
    QString text;
    QString alarm{};        // name of a condition that begins or ends with this; empty: it is over at once
    bool isActive = false;  // of an alarm: it begins
    QString address{};      // of who did it; empty: nobody over a connection
    // given by EventLog
    quint64 sequence = 0;        // from 1, without gaps
    std::int64_t time = 0;       // [ns since 1970]
    std::int64_t monotonic = 0;  // [ns]
};

/// "info", "warning", "error"
QString severityName(JournalEvent::Severity severity);
/// "state", "node", "late", "fault", "set", "lease", "overrun", "security", "quality", "note",
/// "report"
QString kindName(JournalEvent::Kind kind);
messages::EventEntry toEntry(const JournalEvent &event);

/// The newest events of a master; older ones are forgotten.
class EventLog
{
public:
    static constexpr std::size_t Capacity = 1000;
    static constexpr int LongestText = 500;    // [characters] what is longer ends with an ellipsis
    static constexpr int LongestSource = 100;  // [characters] a name that somebody has sent

    /// \param time  of the wall clock [ns since 1970]
    /// \param monotonic  of the clock that never steps [ns]
    void append(JournalEvent event, std::int64_t time, std::int64_t monotonic = 0);
    /// Sequence number of the newest event; 0: there is none yet.
    quint64 newest() const { return m_newest; }
    /// The oldest \a most of those events that came after \a sequence and are still there.
    std::vector<JournalEvent> after(quint64 sequence, std::size_t most) const;

private:
    std::deque<JournalEvent> m_events;
    quint64 m_newest = 0;
};

}  // namespace qplc

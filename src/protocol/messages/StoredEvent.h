// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Events.h"

namespace qplc::messages {

/// An event as a line of a file: docs/design/event-files.md. Who did it is in `source` and `text`.
struct StoredEvent : EventEntry
{
    QString utc;                   // "2026-11-26T07:40:52.123Z", for people; `time` is exact
    double monotonic = 0;          // [s] since the computer was switched on, without its sleep
    Hex64 run;                     // session of the master: each one numbers its events from 1
    QString address;               // of who did it; empty: nobody over a connection
    std::optional<quint64> cycle;  // absent: no cycle ran

    static constexpr auto fields
        = joined(fieldList(field("utc", &StoredEvent::utc), field("monotonic", &StoredEvent::monotonic),
                           field("run", &StoredEvent::run, Presence::Required),
                           field("address", &StoredEvent::address, Presence::WhenSet),
                           field("cycle", &StoredEvent::cycle, Presence::WhenSet)),
                 EventEntry::fields);

    /// With its end.
    QByteArray toLine() const;
    /// \return false: \a line is not such an event
    bool fromLine(const QByteArray &line);
};

}  // namespace qplc::messages

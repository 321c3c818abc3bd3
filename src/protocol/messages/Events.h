// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "Greeting.h"
#include "QPlcMessage.h"
#include "Vocabulary.h"

/// What has happened in the master: docs/protocol.md, section 5.8.
namespace qplc::messages {

enum class Severity : quint8 { Info, Warning, Error };

template<>
struct Names<Severity>
{
    static constexpr std::pair<Severity, const char *> all[]
        = {{Severity::Info, "info"}, {Severity::Warning, "warning"}, {Severity::Error, "error"}};
};

/// The kind of an event that tells the state of the master.
constexpr QLatin1String stateEvent = word("state");
/// The kind of an event that is a Note.
constexpr QLatin1String noteEvent = word("note");

struct EventEntry
{
    quint64 sequence = 0;
    Hex64 time;        // [ns] since 1970
    QString severity;  // name of a Severity, or a word of a newer master
    QString kind;      // "state", ...: likewise
    QString source;    // name of a node; of the master: masterName
    QString text;
    QString alarm;  // name of a condition that lasts; empty: none
    std::optional<bool> active;

    static constexpr auto fields = fieldList(
        field("sequence", &EventEntry::sequence, Presence::Required), field("time", &EventEntry::time),
        field("severity", &EventEntry::severity), field("kind", &EventEntry::kind),
        field("source", &EventEntry::source), field("text", &EventEntry::text),
        field("alarm", &EventEntry::alarm, Presence::WhenSet), field("active", &EventEntry::active, Presence::WhenSet));
};

struct Events
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Events;
    std::vector<EventEntry> events;
    std::optional<bool> more;  // there are newer ones; absent in what comes unasked

    static constexpr auto fields
        = fieldList(field("events", &Events::events), field("more", &Events::more, Presence::WhenSet));
};

struct GetEvents
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetEvents;
    using Answer = Events;
    std::optional<quint64> since;  // those after this sequence number

    static constexpr auto fields = fieldList(field("since", &GetEvents::since, Presence::Checked));
};

/// A node tells what has happened at its devices or in its work.
struct NodeEvent
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::NodeEvent;
    using Answer = NoAnswer;
    static constexpr int longestAlarm = 64;  // [characters]
    Severity severity = Severity::Info;
    QString text;
    QString alarm;  // name of a condition of the node that lasts; empty: none
    std::optional<bool> active;

    static constexpr auto fields = fieldList(
        field("severity", &NodeEvent::severity), field("text", &NodeEvent::text, Presence::Required),
        field("alarm", &NodeEvent::alarm, Presence::WhenSet), field("active", &NodeEvent::active, Presence::WhenSet));
};

/// A remark of a person about what happens now: an event, and so in recordings.
struct Note
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Note;
    using Answer = Done;
    static constexpr int longest = 200;  // [characters] of text
    QString text;
    QString whoever;  // the person

    static constexpr auto fields = fieldList(field("text", &Note::text, Presence::Required),
                                             field("whoever", &Note::whoever, Presence::WhenSet));
};

}  // namespace qplc::messages

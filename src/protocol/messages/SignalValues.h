// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"

/// Values by name, outside of the cycle: docs/protocol.md, section 5.4.
namespace qplc::messages {

struct SignalEntry
{
    QString name;
    QString type;
    QString unit;
    QString description;
    QString value;
    QString writer;                 // "A > B" where several are there; empty: none
    quint8 quality = 0;             // byte of section 6.4
    std::optional<QString> source;  // of several writers, the one whose value it has
    QString holder;                 // of a lease
    std::optional<LeaseState> lease;

    static constexpr auto fields
        = fieldList(field("name", &SignalEntry::name, Presence::Required), field("type", &SignalEntry::type),
                    field("unit", &SignalEntry::unit), field("description", &SignalEntry::description),
                    field("value", &SignalEntry::value), field("writer", &SignalEntry::writer),
                    field("quality", &SignalEntry::quality), field("source", &SignalEntry::source, Presence::WhenSet),
                    field("holder", &SignalEntry::holder, Presence::WhenSet),
                    field("lease", &SignalEntry::lease, Presence::WhenSet));
};

struct Signals
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Signals;
    std::vector<SignalEntry> signals;

    static constexpr auto fields = fieldList(field("signals", &Signals::signals));
};

struct GetSignals
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetSignals;
    using Answer = Signals;
    QStringList names;  // empty: all

    static constexpr auto fields = fieldList(field("names", &GetSignals::names, Presence::Checked));
};

struct SetSignals
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::SetSignals;
    using Answer = Done;
    static constexpr Range durationRange{1, 1e15};  // [ns]
    QMap<QString, QString> values;                  // signal -> value
    std::optional<std::chrono::nanoseconds> duration;

    static constexpr auto fields
        = fieldList(field("values", &SetSignals::values, Presence::Required),
                    field("duration", &SetSignals::duration, Presence::Checked, durationRange));
};

}  // namespace qplc::messages

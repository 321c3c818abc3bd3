// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Events.h"
#include "Statistics.h"

/// What recordings tell beside the cycles: docs/recording.md. A recorder adds `cycle` and `utc`.
namespace qplc::messages {

/// `/events`
struct RecordedEvent : EventEntry
{
    QString address;  // of who did it; empty: nobody over a connection

    static constexpr auto fields
        = joined(fieldList(field("address", &RecordedEvent::address, Presence::WhenSet)), EventEntry::fields);
};

/// `/commands`: a value that was set.
struct RecordedSetting
{
    QString by;       // as windows show it
    QString role;     // empty: nobody has proven one
    QString address;  // empty: the program of the master, or nobody
    QString client;   // uuid
    QString signal;
    QString from;
    QString to;
    QString how;                   // "set", "program", "lease", "came back", "lease lost"
    std::optional<quint64> count;  // of values that are told together

    static constexpr auto fields = fieldList(
        field("by", &RecordedSetting::by), field("role", &RecordedSetting::role, Presence::WhenSet),
        field("address", &RecordedSetting::address, Presence::WhenSet),
        field("client", &RecordedSetting::client, Presence::WhenSet), field("signal", &RecordedSetting::signal),
        field("from", &RecordedSetting::from), field("to", &RecordedSetting::to), field("how", &RecordedSetting::how),
        field("count", &RecordedSetting::count, Presence::WhenSet));
};

/// `/commands`: another message that somebody has sent to have something done.
struct RecordedCommand
{
    QString by;
    QString role;
    QString address;
    QString client;
    QString command;  // "Stop"

    static constexpr auto fields = fieldList(
        field("by", &RecordedCommand::by), field("role", &RecordedCommand::role, Presence::WhenSet),
        field("address", &RecordedCommand::address, Presence::WhenSet),
        field("client", &RecordedCommand::client, Presence::WhenSet), field("command", &RecordedCommand::command));
};

/// `/leases`
struct RecordedLease
{
    QString by;
    QString role;
    QString address;
    QString client;
    QString what;  // "taken", "released", "lost"
    QStringList signals;
    QStringList from;  // who had them
    QString reason;    // of a loss

    static constexpr auto fields
        = fieldList(field("by", &RecordedLease::by), field("role", &RecordedLease::role, Presence::WhenSet),
                    field("address", &RecordedLease::address, Presence::WhenSet),
                    field("client", &RecordedLease::client, Presence::WhenSet), field("what", &RecordedLease::what),
                    field("signals", &RecordedLease::signals), field("from", &RecordedLease::from, Presence::WhenSet),
                    field("reason", &RecordedLease::reason, Presence::WhenSet));
};

/// Durations of the last 10 s [ns].
struct RecordedDuration
{
    qint64 p50 = 0;
    qint64 p99 = 0;
    qint64 maximum = 0;

    static constexpr auto fields = fieldList(field("p50", &RecordedDuration::p50), field("p99", &RecordedDuration::p99),
                                             field("maximum", &RecordedDuration::maximum));
};

struct RecordedNodeStatistics
{
    QString name;
    RecordedDuration execution;
    RecordedDuration roundTrip;
    RecordedDuration slack;
    QMap<QString, double> counters;

    static constexpr auto fields = fieldList(
        field("name", &RecordedNodeStatistics::name), field("execution", &RecordedNodeStatistics::execution),
        field("roundTrip", &RecordedNodeStatistics::roundTrip), field("slack", &RecordedNodeStatistics::slack),
        field("counters", &RecordedNodeStatistics::counters));
};

/// `/statistics`
struct RecordedStatistics
{
    RecordedDuration lateness;
    RecordedDuration execution;
    RecordedDuration roundTrip;
    RecordedDuration slack;
    QMap<QString, double> counters;
    std::vector<RecordedNodeStatistics> nodes;

    static constexpr auto fields = fieldList(
        field("lateness", &RecordedStatistics::lateness), field("execution", &RecordedStatistics::execution),
        field("roundTrip", &RecordedStatistics::roundTrip), field("slack", &RecordedStatistics::slack),
        field("counters", &RecordedStatistics::counters), field("nodes", &RecordedStatistics::nodes));
};

/// On one line, without an end.
QByteArray lineOf(const QJsonObject &object);

}  // namespace qplc::messages

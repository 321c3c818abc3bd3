// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "QPlcMessage.h"
#include "Vocabulary.h"

/// What a master and its nodes do: docs/protocol.md, section 5.4.
namespace qplc::messages {

/// A registered node, as its master sees it.
struct NodeEntry
{
    QString name;
    quint16 id = 0;
    int inputs = 0;  // number of signals
    int outputs = 0;
    bool listener = false;
    bool critical = false;
    QString state;
    int every = 1;  // [cycles] for each frame of a listener
    QString policy;
    QString transport;
    QString address;
    quint64 lateAnswers = 0;
    quint64 duplicates = 0;
    quint64 rejected = 0;
    quint64 forged = 0;
    quint64 resent = 0;
    QString faults;

    static constexpr auto fields = std::make_tuple(
        field("name", &NodeEntry::name, Presence::Required), field("id", &NodeEntry::id),
        field("inputs", &NodeEntry::inputs), field("outputs", &NodeEntry::outputs),
        field("listener", &NodeEntry::listener), field("critical", &NodeEntry::critical),
        field("state", &NodeEntry::state), field("every", &NodeEntry::every), field("policy", &NodeEntry::policy),
        field("transport", &NodeEntry::transport), field("address", &NodeEntry::address),
        field("lateAnswers", &NodeEntry::lateAnswers), field("duplicates", &NodeEntry::duplicates),
        field("rejected", &NodeEntry::rejected), field("forged", &NodeEntry::forged),
        field("resent", &NodeEntry::resent), field("faults", &NodeEntry::faults, Presence::WhenSet));
};

/// A Stop that ended the phase that ran last.
struct StopEntry
{
    QString whoever;
    QString how;
    Hex64 time;          // [ns] since 1970
    bool yours = false;  // the connection that reads this has sent it

    static constexpr auto fields = std::make_tuple(field("whoever", &StopEntry::whoever), field("how", &StopEntry::how),
                                                   field("time", &StopEntry::time), field("yours", &StopEntry::yours));
    friend bool operator==(const StopEntry &a, const StopEntry &b)
    {
        return a.whoever == b.whoever && a.how == b.how && a.time == b.time && a.yours == b.yours;
    }
};

struct State
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::State;
    MasterState state = MasterState::Unknown;
    QString reason;   // why it is SafeStop or Fault
    QString remains;  // what still keeps Reset from being done
    bool armed = false;
    bool armingRequired = false;
    Hex64 cycle;
    std::chrono::nanoseconds period{0};
    ClockKind clock = ClockKind::RealTime;
    double scale = 1.0;
    QString profile;
    QString profileReason;
    Hex64 session;
    std::vector<NodeEntry> nodes;
    QMap<QString, quint64> counters;
    Hex64 digest;
    std::optional<StopEntry> stopped;
    QString faults;

    static constexpr auto fields = std::make_tuple(
        field("state", &State::state), field("reason", &State::reason), field("remains", &State::remains),
        field("armed", &State::armed), field("armingRequired", &State::armingRequired), field("cycle", &State::cycle),
        field("period", &State::period), field("clock", &State::clock), field("scale", &State::scale),
        field("profile", &State::profile), field("profileReason", &State::profileReason),
        field("session", &State::session), field("nodes", &State::nodes), field("counters", &State::counters),
        field("digest", &State::digest), field("stopped", &State::stopped, Presence::WhenSet),
        field("faults", &State::faults, Presence::WhenSet));
};

struct GetState
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetState;
    using Answer = State;
    static constexpr auto fields = std::make_tuple();
};

struct TurnEntry
{
    QString node;
    QString phase;  // "step", "outputs", "update"

    static constexpr auto fields
        = std::make_tuple(field("node", &TurnEntry::node, Presence::Required), field("phase", &TurnEntry::phase));
};

struct LinkEntry
{
    QString signal;
    QString from;  // "Master"; empty: no node
    QString to;
    int age = 0;  // [cycles]
    bool sameCycle = false;

    static constexpr auto fields = std::make_tuple(
        field("signal", &LinkEntry::signal, Presence::Required), field("from", &LinkEntry::from),
        field("to", &LinkEntry::to), field("age", &LinkEntry::age), field("sameCycle", &LinkEntry::sameCycle));
};

struct Schedule
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Schedule;
    std::vector<std::vector<TurnEntry>> stages;
    std::vector<LinkEntry> links;

    static constexpr auto fields
        = std::make_tuple(field("stages", &Schedule::stages), field("links", &Schedule::links));
};

struct GetSchedule
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetSchedule;
    using Answer = Schedule;
    static constexpr auto fields = std::make_tuple();
};

}  // namespace qplc::messages

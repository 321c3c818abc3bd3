// SPDX-License-Identifier: Apache-2.0
#include "SlaveStates.h"

namespace qplc {

namespace {

using S = QPlcSlaveNode::State;
using E = SlaveEvent;
using A = SlaveAction;
using R = StateRules<S, E, A>;

constexpr std::uint32_t away = R::in(S::Disconnected, S::Rejected);
constexpr std::uint32_t coming = R::in(S::Connecting, S::Registering);
constexpr std::uint32_t resting = R::in(S::Registered, S::Initializing, S::Ready);
constexpr std::uint32_t cycling = R::in(S::RealTime, S::SafeStop, S::Fault);
constexpr std::uint32_t all = away | coming | resting | cycling;

constexpr const char *connectedAlready = "connected already; disconnect first";
constexpr const char *notNow = "not possible now";

constexpr R::Rule rules[] = {
    R::on(E::Connect, away | R::in(S::SafeStop, S::Fault), R::go(S::Connecting, A::OpenConnection)),
    R::on(E::Connect, coming | resting | R::in(S::RealTime), R::refuse(connectedAlready)),
    R::on(E::Retry, away | R::in(S::SafeStop, S::Fault), R::go(S::Connecting, A::OpenConnection)),
    R::on(E::Retry, coming | resting | R::in(S::RealTime), R::ignore()),
    R::on(E::Leave, all, R::go(S::Disconnected, A::CloseConnection)),
    R::on(E::AddedLocally, R::in(S::Disconnected), R::go(S::Registered)),
    R::on(E::AddedLocally, all & ~R::in(S::Disconnected), R::refuse(connectedAlready)),

    R::on(E::Connected, R::in(S::Connecting), R::go(S::Registering, A::Greet)),
    R::on(E::Connected, all & ~R::in(S::Connecting), R::ignore()),
    R::on(E::ConnectionLost, coming | resting, R::go(S::Disconnected, A::CloseAndRetry)),
    R::on(E::ConnectionLost, R::in(S::RealTime), R::go(S::SafeStop, A::CloseAndRetry)),
    R::on(E::ConnectionLost, R::in(S::SafeStop, S::Fault), R::stay(A::CloseAndRetry)),
    R::on(E::ConnectionLost, away, R::ignore()),

    R::on(E::HelloCame, R::in(S::Registering), R::stay(A::Proceed)),
    R::on(E::HelloCame, all & ~R::in(S::Registering), R::refuse(notNow)),
    R::on(E::Accepted, R::in(S::Registering), R::stay(A::Proceed)),
    R::on(E::Accepted, all & ~R::in(S::Registering), R::refuse(notNow)),
    R::on(E::ChannelAttached, R::in(S::Registering), R::go(S::Registered, A::TellRegistered)),
    R::on(E::ChannelAttached, all & ~R::in(S::Registering), R::refuse(notNow)),
    R::on(E::Refused, coming | resting | cycling, R::go(S::Rejected, A::CloseAndRetry)),
    R::on(E::Refused, away, R::ignore()),
    R::on(E::MasterEnded, coming | resting | cycling, R::go(S::Disconnected, A::CloseAndRetry)),
    R::on(E::MasterEnded, away, R::ignore()),
    R::on(E::OutputsWanted, resting | R::in(S::Fault), R::go(S::Initializing, A::GiveOutputs)),
    R::on(E::OutputsWanted, away | coming | R::in(S::RealTime, S::SafeStop), R::refuse(notNow)),
    R::on(E::ValuesCame, resting, R::go(S::Ready, A::TakeValues)),
    R::on(E::ValuesCame, away | coming | cycling, R::refuse(notNow)),
    R::on(E::InitializationFailed, resting, R::go(S::Registered)),
    R::on(E::InitializationFailed, away | coming | cycling, R::ignore()),
    R::on(E::PhaseStarted, R::in(S::Registered, S::Ready), R::go(S::RealTime, A::StartCycles)),
    R::on(E::PhaseStarted, away | coming | cycling | R::in(S::Initializing), R::refuse(notNow)),
    R::on(E::PhaseStopped, resting, R::go(S::Registered)),
    R::on(E::PhaseStopped, R::in(S::RealTime, S::SafeStop), R::go(S::Registered, A::EndCycles)),
    R::on(E::PhaseStopped, R::in(S::Fault), R::stay(A::EndCycles)),
    R::on(E::PhaseStopped, away | coming, R::ignore()),

    R::on(E::ToldSafeStop, R::in(S::RealTime), R::go(S::SafeStop)),
    R::on(E::ToldSafeStop, all & ~R::in(S::RealTime), R::ignore()),
    R::on(E::WatchdogTimedOut, R::in(S::RealTime), R::go(S::SafeStop, A::CloseAndRetry)),
    R::on(E::WatchdogTimedOut, R::in(S::SafeStop, S::Fault), R::stay(A::CloseAndRetry)),
    R::on(E::WatchdogTimedOut, away | coming | resting, R::ignore()),
    R::on(E::CodeFailed, resting | R::in(S::RealTime, S::SafeStop), R::go(S::Fault)),
    R::on(E::CodeFailed, R::in(S::Fault), R::stay()),
    R::on(E::CodeFailed, away | coming, R::ignore()),
};

constexpr SlaveStateTable table(rules);
static_assert(table.isComplete(), "each pair of state and event has exactly one rule");

}  // namespace

const SlaveStateTable &slaveStates()
{
    return table;
}

const char *nameOf(QPlcSlaveNode::State state)
{
    static constexpr const char *names[SlaveStateCount]
        = {"Disconnected", "Connecting", "Registering", "Rejected", "Registered",
           "Initializing", "Ready",      "RealTime",    "SafeStop", "Fault"};
    return names[std::size_t(state)];
}

const char *nameOf(SlaveEvent event)
{
    static constexpr const char *names[SlaveEventCount] = {"Connect",         "Retry",
                                                           "Leave",           "AddedLocally",
                                                           "Connected",       "ConnectionLost",
                                                           "HelloCame",       "Accepted",
                                                           "ChannelAttached", "Refused",
                                                           "MasterEnded",     "OutputsWanted",
                                                           "ValuesCame",      "InitializationFailed",
                                                           "PhaseStarted",    "PhaseStopped",
                                                           "ToldSafeStop",    "WatchdogTimedOut",
                                                           "CodeFailed"};
    return names[std::size_t(event)];
}

const char *nameOf(SlaveAction action)
{
    static constexpr const char *names[] = {"",           "OpenConnection", "CloseConnection", "CloseAndRetry",
                                            "Greet",      "Proceed",        "TellRegistered",  "GiveOutputs",
                                            "TakeValues", "StartCycles",    "EndCycles"};
    return names[std::size_t(action)];
}

}  // namespace qplc

// SPDX-License-Identifier: Apache-2.0
#include "MasterStates.h"

namespace qplc {

namespace {

using S = QPlcMasterNode::State;
using E = MasterEvent;
using A = MasterAction;
using R = StateRules<S, E, A>;

constexpr std::uint32_t calm = R::in(S::Off, S::Ready);
constexpr std::uint32_t cycling = R::in(S::RealTime, S::WaitingForLateSlaves);
constexpr std::uint32_t latched = R::in(S::SafeStop, S::Fault);
constexpr std::uint32_t all = calm | cycling | latched | R::in(S::Initializing);

constexpr const char *underWay = "an initialization or a start is under way; wait for its end, or stop it";
constexpr const char *cyclesRun = "cycles run; stop them first";
constexpr const char *notInitialized = "not initialized; initialize first";
constexpr const char *faultLatched = "fault latched: %1; reset first";
constexpr const char *missing = "%2";  // names and remedy
constexpr const char *nothingLatched = "nothing is latched";

constexpr R::Rule rules[] = {
    R::on(E::Initialize, calm, R::go(S::Initializing, A::CollectOutputs)),
    R::on(E::Initialize, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::Initialize, cycling, R::refuse(cyclesRun)),
    R::on(E::Initialize, latched, R::refuse(faultLatched)),

    R::on(E::InitializeIncomplete, calm, R::refuse(missing)),
    R::on(E::InitializeIncomplete, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::InitializeIncomplete, cycling, R::refuse(cyclesRun)),
    R::on(E::InitializeIncomplete, latched, R::refuse(faultLatched)),

    R::on(E::Arm, R::in(S::Ready), R::stay(A::IssueToken)),
    R::on(E::Arm, R::in(S::Off), R::refuse(notInitialized)),
    R::on(E::Arm, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::Arm, cycling, R::refuse(cyclesRun)),
    R::on(E::Arm, latched, R::refuse(faultLatched)),

    R::on(E::Start, R::in(S::Off), R::go(S::Initializing, A::CollectThenStart)),
    R::on(E::Start, R::in(S::Ready), R::go(S::Initializing, A::StartNodes)),
    R::on(E::Start, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::Start, cycling, R::refuse(cyclesRun)),
    R::on(E::Start, latched, R::refuse(faultLatched)),

    R::on(E::StartIncomplete, calm, R::refuse(missing)),
    R::on(E::StartIncomplete, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::StartIncomplete, cycling, R::refuse(cyclesRun)),
    R::on(E::StartIncomplete, latched, R::refuse(faultLatched)),

    R::on(E::StartUnarmed, R::in(S::Off), R::refuse("not initialized; initialize, arm, then start")),
    R::on(E::StartUnarmed, R::in(S::Ready), R::refuse("not armed in the last 5 s; arm, then start")),
    R::on(E::StartUnarmed, R::in(S::Initializing), R::refuse(underWay)),
    R::on(E::StartUnarmed, cycling, R::refuse(cyclesRun)),
    R::on(E::StartUnarmed, latched, R::refuse(faultLatched)),

    R::on(E::Stop, R::in(S::Off), R::stay()),
    R::on(E::Stop, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::Stop, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::Stop, cycling, R::go(S::Off, A::EndCycles)),
    R::on(E::Stop, latched, R::stay()),

    R::on(E::SafeStop, R::in(S::Off), R::stay()),
    R::on(E::SafeStop, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::SafeStop, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::SafeStop, cycling, R::go(S::SafeStop, A::MakeCyclesSafe)),
    R::on(E::SafeStop, latched, R::stay()),

    R::on(E::Reset, R::in(S::Off), R::stay()),
    R::on(E::Reset, R::in(S::Initializing, S::Ready) | cycling, R::refuse(nothingLatched)),
    R::on(E::Reset, latched, R::go(S::Off, A::Unlatch)),
    R::on(E::ResetTooEarly, R::in(S::Off), R::stay()),
    R::on(E::ResetTooEarly, R::in(S::Initializing, S::Ready) | cycling, R::refuse(nothingLatched)),
    R::on(E::ResetTooEarly, latched, R::refuse("fault latched: %1; its cause is still there: %2")),

    R::on(E::Listen, calm | R::in(S::Fault), R::stay()),
    R::on(E::Listen, R::in(S::Initializing, S::SafeStop) | cycling,
          R::refuse("stop the plant first, or reset it after a safe stop")),
    R::on(E::AddNode, R::in(S::Off), R::stay()),
    R::on(E::AddNode, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::AddNode, R::in(S::Initializing) | cycling | latched,
          R::refuse("stop the plant first, or reset it after a safe stop or a fault")),
    R::on(E::End, R::in(S::Off, S::Fault), R::stay()),
    R::on(E::End, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::End, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::End, cycling, R::go(S::Off, A::EndCycles)),
    R::on(E::End, R::in(S::SafeStop), R::stay(A::EndCycles)),

    R::on(E::StatesInitialized, R::in(S::Initializing), R::go(S::Ready)),
    R::on(E::StatesInitialized, calm | cycling | latched, R::ignore()),
    R::on(E::CyclesStarted, R::in(S::Initializing), R::go(S::RealTime)),
    R::on(E::CyclesStarted, calm | cycling | latched, R::ignore()),
    R::on(E::SequenceFailed, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::SequenceFailed, calm | cycling | latched, R::ignore()),
    R::on(E::ThreadFailed, R::in(S::Initializing), R::go(S::Fault, A::EndSequence)),
    R::on(E::ThreadFailed, calm | cycling | latched, R::ignore()),
    R::on(E::ServerListens, R::in(S::Fault), R::go(S::Off)),
    R::on(E::ServerListens, calm, R::stay()),
    R::on(E::ServerListens, R::in(S::Initializing, S::SafeStop) | cycling, R::ignore()),
    R::on(E::ServerFailed, calm, R::go(S::Fault, A::ForgetInitialization)),
    R::on(E::ServerFailed, R::in(S::Fault), R::stay()),
    R::on(E::ServerFailed, R::in(S::Initializing, S::SafeStop) | cycling, R::ignore()),

    R::on(E::NodeJoined, R::in(S::Off, S::Initializing) | latched, R::stay()),
    R::on(E::NodeJoined, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::NodeJoined, cycling, R::stay(A::LetJoin)),
    R::on(E::ListenerJoined, R::in(S::Off, S::Initializing, S::Fault), R::stay()),
    R::on(E::ListenerJoined, R::in(S::Ready, S::SafeStop) | cycling, R::stay(A::LetJoin)),
    R::on(E::NodeLeft, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::NodeLeft, R::in(S::Off, S::Initializing) | cycling | latched, R::stay()),
    R::on(E::CriticalNodeLeft, R::in(S::Ready), R::go(S::Off, A::ForgetInitialization)),
    R::on(E::CriticalNodeLeft, cycling, R::go(S::SafeStop, A::MakeCyclesSafe)),
    R::on(E::CriticalNodeLeft, R::in(S::Off, S::Initializing) | latched, R::stay()),
    R::on(E::NodeFailed, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::NodeFailed, cycling, R::go(S::Off, A::EndCycles)),
    R::on(E::NodeFailed, calm | latched, R::ignore()),
    R::on(E::CriticalNodeFailed, R::in(S::Initializing), R::go(S::Off, A::EndSequence)),
    R::on(E::CriticalNodeFailed, cycling, R::go(S::SafeStop, A::MakeCyclesSafe)),
    R::on(E::CriticalNodeFailed, calm | latched, R::ignore()),

    R::on(E::WaitBegan, R::in(S::RealTime), R::go(S::WaitingForLateSlaves)),
    R::on(E::WaitBegan, all & ~R::in(S::RealTime), R::ignore()),
    R::on(E::WaitEnded, R::in(S::WaitingForLateSlaves), R::go(S::RealTime)),
    R::on(E::WaitEnded, all & ~R::in(S::WaitingForLateSlaves), R::ignore()),
    R::on(E::CyclesTripped, cycling, R::go(S::SafeStop, A::LatchReason)),
    R::on(E::CyclesTripped, all & ~cycling, R::ignore()),
    R::on(E::CycleLimitReached, cycling, R::go(S::Off, A::EndCycles)),
    R::on(E::CycleLimitReached, all & ~cycling, R::ignore()),
    R::on(E::OverrunStop, cycling, R::go(S::Off, A::EndCycles)),
    R::on(E::OverrunStop, all & ~cycling, R::ignore()),
};

constexpr MasterStateTable table(rules);
static_assert(table.isComplete(), "each pair of state and event has exactly one rule");

}  // namespace

const MasterStateTable &masterStates()
{
    return table;
}

const char *nameOf(QPlcMasterNode::State state)
{
    switch (state) {
    case S::Off:
        return "Off";
    case S::Initializing:
        return "Initializing";
    case S::Ready:
        return "Ready";
    case S::RealTime:
        return "RealTime";
    case S::WaitingForLateSlaves:
        return "WaitingForLateSlaves";
    case S::SafeStop:
        return "SafeStop";
    case S::Fault:
        return "Fault";
    }
    return "";
}

const char *nameOf(MasterEvent event)
{
    static constexpr const char *names[MasterEventCount] = {"Initialize",
                                                            "InitializeIncomplete",
                                                            "Arm",
                                                            "Start",
                                                            "StartIncomplete",
                                                            "StartUnarmed",
                                                            "Stop",
                                                            "SafeStop",
                                                            "Reset",
                                                            "ResetTooEarly",
                                                            "Listen",
                                                            "AddNode",
                                                            "End",
                                                            "StatesInitialized",
                                                            "CyclesStarted",
                                                            "SequenceFailed",
                                                            "ThreadFailed",
                                                            "ServerListens",
                                                            "ServerFailed",
                                                            "NodeJoined",
                                                            "ListenerJoined",
                                                            "NodeLeft",
                                                            "CriticalNodeLeft",
                                                            "NodeFailed",
                                                            "CriticalNodeFailed",
                                                            "WaitBegan",
                                                            "WaitEnded",
                                                            "CyclesTripped",
                                                            "CycleLimitReached",
                                                            "OverrunStop"};
    return names[std::size_t(event)];
}

const char *requestName(MasterEvent event)
{
    switch (event) {
    case E::Initialize:
    case E::InitializeIncomplete:
        return "initialization";
    case E::Arm:
        return "arming";
    case E::Start:
    case E::StartIncomplete:
    case E::StartUnarmed:
        return "a start";
    case E::Reset:
    case E::ResetTooEarly:
        return "a reset";
    case E::Listen:
        return "starting the server";
    case E::AddNode:
        return "adding a node";
    default:
        return nameOf(event);
    }
}

const char *nameOf(MasterAction action)
{
    static constexpr const char *names[] = {"",
                                            "CollectOutputs",
                                            "CollectThenStart",
                                            "StartNodes",
                                            "IssueToken",
                                            "EndSequence",
                                            "ForgetInitialization",
                                            "EndCycles",
                                            "MakeCyclesSafe",
                                            "LatchReason",
                                            "Unlatch",
                                            "LetJoin"};
    return names[std::size_t(action)];
}

}  // namespace qplc

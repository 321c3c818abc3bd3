// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterNode.h"
#include "StateTable.h"

namespace qplc {

/// What can happen to a master. docs/design/states.md is made from the table.
enum class MasterEvent : std::uint8_t {
    // asked for by people and programs
    Initialize,
    InitializeIncomplete,  ///< an initialization while a node is missing
    Arm,
    Start,
    StartIncomplete,  ///< a start while a node is missing
    StartUnarmed,     ///< a start, where arming is required and the token is missing, wrong or too old
    Stop,
    SafeStop,
    Reset,
    ResetTooEarly,  ///< a reset while the cause is still there
    Listen,
    AddNode,  ///< a node in the process of the master
    End,      ///< the master, its server or a local node ends
    // of the sequences
    StatesInitialized,
    CyclesStarted,
    SequenceFailed,
    ThreadFailed,
    ServerListens,
    ServerFailed,
    // of the nodes
    NodeJoined,
    ListenerJoined,
    NodeLeft,
    CriticalNodeLeft,
    NodeFailed,
    CriticalNodeFailed,
    // of the cycle
    WaitBegan,
    WaitEnded,
    CyclesTripped,  ///< a limit was passed: the cycles are safe already
    CycleLimitReached,
    OverrunStop
};
constexpr std::size_t MasterEventCount = std::size_t(MasterEvent::OverrunStop) + 1;
constexpr std::size_t MasterStateCount = std::size_t(QPlcMasterNode::Fault) + 1;

/// What the master does when an event is accepted.
enum class MasterAction : std::uint8_t {
    None,
    CollectOutputs,    ///< asks all nodes for their initial outputs
    CollectThenStart,  ///< likewise, and starts afterwards
    StartNodes,        ///< tells all nodes that the phase begins
    IssueToken,        ///< permits one start
    EndSequence,       ///< tells who takes part that it is over
    ForgetInitialization,
    EndCycles,       ///< ends the cycles and tells the nodes
    MakeCyclesSafe,  ///< latches the reason, and has the cycles tell safe values
    LatchReason,     ///< of cycles that are safe already
    Unlatch,         ///< ends the cycles and forgets the reason
    LetJoin          ///< brings the node into the phase, or the initialization, that is there
};

using MasterStateTable
    = StateTable<QPlcMasterNode::State, MasterEvent, MasterAction, MasterStateCount, MasterEventCount>;

/// The table; complete.
const MasterStateTable &masterStates();

const char *nameOf(QPlcMasterNode::State state);
const char *nameOf(MasterEvent event);
/// Of what people ask for, in the words of its refusal: "start".
const char *requestName(MasterEvent event);
const char *nameOf(MasterAction action);

}  // namespace qplc

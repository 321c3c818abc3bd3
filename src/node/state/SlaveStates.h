// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSlaveNode.h"
#include "StateTable.h"

namespace qplc {

/// What can happen to a node. docs/design/states.md is made from the table.
enum class SlaveEvent : std::uint8_t {
    // of the program
    Connect,       ///< it was told to
    Retry,         ///< the pause after a failed or lost connection is over
    Leave,         ///< it was told to
    AddedLocally,  ///< to a master in the same process
    // of the connection
    Connected,
    ConnectionLost,  ///< or never came about
    // messages of the master
    HelloCame,
    Accepted,         ///< Registered
    ChannelAttached,  ///< the cyclic channel is there
    Refused,          ///< Rejected, or what the master says cannot be
    MasterEnded,
    OutputsWanted,  ///< SendYourInitialOutputStates
    ValuesCame,     ///< InitializeWithValues
    InitializationFailed,
    PhaseStarted,  ///< RealTimeStarted
    PhaseStopped,  ///< RealTimeStopped
    // of the cycle
    ToldSafeStop,  ///< a frame with the flag SafeStop
    WatchdogTimedOut,
    CodeFailed  ///< a function of the derived class threw
};
constexpr std::size_t SlaveEventCount = std::size_t(SlaveEvent::CodeFailed) + 1;
constexpr std::size_t SlaveStateCount = std::size_t(QPlcSlaveNode::Fault) + 1;

enum class SlaveAction : std::uint8_t {
    None,
    OpenConnection,
    CloseConnection,
    CloseAndRetry,  ///< as the ReconnectPolicy says
    Greet,
    Proceed,  ///< with the registration
    TellRegistered,
    GiveOutputs,
    TakeValues,
    StartCycles,
    EndCycles  ///< with the safe state
};

using SlaveStateTable = StateTable<QPlcSlaveNode::State, SlaveEvent, SlaveAction, SlaveStateCount, SlaveEventCount>;

/// The table; complete. Whatever leads out of RealTime brings the node into its safe state.
const SlaveStateTable &slaveStates();

const char *nameOf(QPlcSlaveNode::State state);
const char *nameOf(SlaveEvent event);
const char *nameOf(SlaveAction action);

}  // namespace qplc

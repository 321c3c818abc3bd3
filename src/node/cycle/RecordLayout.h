// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// What the records of a RecordRing look like: numbers of this machine, each record as long as a
/// multiple of 8 bytes.
///
/// A ring has two regions. That of the cycles is written by their thread, that of the texts by the
/// thread of the master: what people and programs did, and what happened.
///
/// A record of a cycle is: RecordHead, RecordedCycle, a RecordedNode for each node, the process
/// image (ProcessImage::totalSize() bytes: values, padding, qualities), and then, where they are
/// not empty, the image before and the raw outputs, each padded to 8 bytes.
///
/// The inputs that a node gets in cycle k are a function of the records k-1 and k. If the record k
/// has an image before, it shows what inputs of cycle k were cut from: values were set, nodes or
/// leases have changed, cycles were skipped or have no record, or the master stops safely.
/// Otherwise the own signals of the master (RingDescription) are as in the record k, and all others
/// as in the record k-1. Inputs of the same cycle are as in the record k, unless the record has raw
/// inputs of the node: then these are what was sent.
enum class RecordKind : std::uint16_t {
    Cycle = 1,     ///< RecordedCycle and what follows it
    Gap = 2,       ///< RecordedGap: cycles without a record
    End = 3,       ///< RecordedEnd: the phase is over, and nothing follows
    Roster = 4,    ///< RecordedRoster and its text: the nodes of the cycles from `first` on
    Join = 5,      ///< RecordedJoin, initial outputs and inputs: a node takes part from `first` on
    Settings = 6,  ///< RecordedSettings: values from outside that the next cycle has adopted
    Text = 7,      ///< RecordedText and its text, in the region of the texts
    LastText = 8   ///< RecordedText without a text: no other one belongs to this phase
};

struct RecordHead
{
    std::uint64_t commit = 0;  ///< place of this record among all bytes of the ring; written last
    std::uint32_t size = 0;    ///< [byte] with this head
    RecordKind kind = RecordKind::Cycle;
    std::uint16_t reserved = 0;
};

struct RecordedCycle
{
    enum Flag : std::uint32_t {
        Safe = 1,         ///< the master has stopped safely: values of nodes were not taken
        CaughtUp = 2,     ///< its period was over before it began
        NewNodes = 4,     ///< nodes have joined or left, or leases have changed, before this cycle
        Timed = 8,        ///< the times of this record are real
        Incomplete = 16,  ///< a node that was asked, and is no listener, has not answered
        SetValues = 32    ///< signals were set, or have moved on their slopes, before this cycle
    };

    std::uint64_t number = 0;      ///< of the cycle, from 0 in each phase
    std::int64_t wallTime = 0;     ///< at its end [ns since 1970-01-01 UTC]; 0: the clock is not timed
    std::int64_t lateness = 0;     ///< of its begin [ns]
    std::uint64_t skipped = 0;     ///< cycles that were left out right before it
    std::uint64_t digest = 0;      ///< of all images of the phase up to this one: ProcessImage::digest()
    std::uint32_t flags = 0;       ///< of Flag
    std::uint32_t nodes = 0;       ///< RecordedNodes
    std::uint32_t imageSize = 0;   ///< [byte]
    std::uint32_t beforeSize = 0;  ///< [byte] of the image before; 0 or imageSize
    std::uint32_t rawSize = 0;     ///< [byte] of all raw outputs and inputs, with their padding
    std::uint32_t roster = 0;      ///< number of the RecordedRoster; 0: no roster
};

/// What the master has exchanged with a node in a cycle.
struct RecordedNode
{
    enum Flag : std::uint16_t {
        Asked = 1,         ///< a request was sent, or the local node was called
        Answered = 2,      ///< the answer to this cycle has come
        Stored = 4,        ///< an answer was stored in this cycle; `cycle` says to which request
        Late = 8,          ///< counted as late
        Faulted = 16,      ///< its code has failed
        IsSafe = 32,       ///< it is in its safe state
        Lost = 64,         ///< its connection is lost
        HasRaw = 128,      ///< its outputs are among the raw ones: the image does not show all of them
        IsLocal = 256,     ///< of the process of the master
        Listens = 512,     ///< nobody waits for it
        HasInputs = 1024,  ///< its inputs are among the raw ones: the images do not show all of them
        Hidden = 2048      ///< two-phase: neither the image nor raw outputs show what was stored
    };

    std::uint64_t cycle = 0;   ///< newest request that it has answered; NoCycle: none yet
    std::int64_t arrival = 0;  ///< of that answer, on the clock of the master [ns]; 0: not timed
    std::uint32_t info = 0;    ///< of that answer: what the node says of its own time [ns]
    std::uint16_t id = 0;
    std::uint16_t flags = 0;    ///< of Flag
    std::uint32_t rawSize = 0;  ///< [byte] of its raw outputs, without their padding
    /// Which requests before `cycle` it has computed, as far as its answers say: bit i stands for
    /// the request of cycle - 1 - i.
    std::uint32_t history = 0;
    std::uint32_t inputsSize = 0;  ///< [byte] of its raw inputs, without their padding
    std::uint32_t reserved = 0;

    static constexpr std::uint64_t NoCycle = ~std::uint64_t(0);
};

/// Cycles that were computed and have no record, because a recorder had left no room for them.
struct RecordedGap
{
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t cycles = 0;   ///< that were computed, of those from first to last
    std::uint64_t skipped = 0;  ///< that were left out: right before the first, and of those up to the last
    std::uint64_t digest = 0;   ///< as it was after the last of them
};

struct RecordedEnd
{
    std::uint64_t cycles = 0;  ///< that were computed in the phase
    std::uint64_t last = 0;    ///< number of the last of them, if there are any
    std::uint64_t digest = 0;
    std::uint64_t missing = 0;  ///< cycles without a record, of all gaps
};

/// The nodes of the cycles from `first` on. It comes before the first of these cycles, and again
/// from time to time: the first one may have been replaced.
struct RecordedRoster
{
    std::uint64_t first = 0;
    std::uint32_t number = 0;    ///< from 1 in each phase
    std::uint32_t textSize = 0;  ///< [byte] of the JSON that follows: RosterContent::toText(). 0: it is too long
};

/// A node takes part in the cycles from `first` on. What it was given before that follows: first
/// the initial outputs that it has sent, then its initial inputs, each padded.
struct RecordedJoin
{
    std::uint64_t first = 0;
    std::uint32_t outputsSize = 0;  ///< [byte]
    std::uint32_t inputsSize = 0;   ///< [byte]
    std::uint16_t id = 0;           ///< of the node
    std::uint16_t reserved[3] = {};
};

/// Values that were set from outside are numbered by the master, from 1. It comes right before the
/// record of the cycle that has adopted them.
struct RecordedSettings
{
    std::uint64_t cycle = 0;
    std::uint64_t adopted = 0;  ///< number of the newest value that this cycle has adopted
};

/// What has happened, as one object of JSON, which follows.
struct RecordedText
{
    /// Where it belongs: the channel of a recording.
    enum Topic : std::uint16_t { Event = 1, Command = 2, Lease = 3, Statistics = 4 };

    std::uint64_t number = 0;    ///< of all texts of this phase, from 1; those between two that follow one another
                                 ///< had no room, or have been replaced
    std::uint64_t cycle = 0;     ///< newest one when it happened; BeforePhase: that was before the phase
    std::uint64_t settings = 0;  ///< number of the value that it tells, see RecordedSettings; 0: it tells none
    std::int64_t wallTime = 0;   ///< [ns since 1970-01-01 UTC]
    std::uint32_t textSize = 0;  ///< [byte]
    std::uint16_t topic = Event;
    std::uint16_t reserved = 0;

    static constexpr std::uint64_t BeforePhase = ~std::uint64_t(0);
};

static_assert(sizeof(RecordedSettings) == 16 && sizeof(RecordedText) == 40);
static_assert(sizeof(RecordHead) == 16 && sizeof(RecordedCycle) == 64 && sizeof(RecordedNode) == 40
              && sizeof(RecordedGap) == 40 && sizeof(RecordedEnd) == 32 && sizeof(RecordedRoster) == 16
              && sizeof(RecordedJoin) == 24);

/// \a size, rounded up to a multiple of 8.
constexpr std::uint32_t paddedRecordSize(std::uint32_t size)
{
    return (size + 7) & ~std::uint32_t(7);
}

}  // namespace qplc

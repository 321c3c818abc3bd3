// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ListeningInterval.h"
#include "MulticastParts.h"
#include "NodeRuntime.h"
#include "NodeStatistics.h"
#include "RecordLayout.h"
#include "SentCycles.h"
#include "SignalGuard.h"
#include "protocol/CyclicFrame.h"
#include "signals/ProcessImage.h"
#include "transport/CyclicHub.h"
#include "transport/FrameCutter.h"
#include "transport/TransportKind.h"

#include <atomic>
#include <memory>
#include <vector>

namespace qplc {

/// What a payload of \a layout is in a cycle, in frames that are sealed or not.
FrameVolume frameVolume(const PayloadLayout &layout, bool isSealed);

/// One registered node as the cycle of the master sees it: how its frames are cut from the process
/// image and pasted back.
///
/// Made by the thread of the master; from adoption on the cycle thread's, except for what is
/// atomic.
struct NodeSlot
{
    /// What the records of cycles say of its answers.
    struct Exchange
    {
        std::uint64_t cycle = RecordedNode::NoCycle;  // newest request that it has answered
        std::int64_t arrival = 0;                     // of that answer [ns]
        std::uint32_t info = 0;                       // of that answer
        std::uint32_t history = 0;                    // see RecordedNode
        bool isStored = false;                        // an answer, in this cycle
        bool isChanged = false;                       // the image may not have its values as they came
        bool hasRawInputs = false;                    // the record of this cycle has them

        /// An answer to the request of \a answered. \param before  [cycles] back to the one that
        ///     the node has computed before; 0: it does not say
        void note(std::uint64_t answered, std::uint64_t before) noexcept
        {
            const std::uint64_t step = cycle == RecordedNode::NoCycle || answered <= cycle ? 0 : answered - cycle;
            history = step >= 32 ? 0 : history << step;
            for (const std::uint64_t known : {step, before}) {
                if (known >= 1 && known <= 32)
                    history |= std::uint32_t(1) << (known - 1);
            }
            cycle = answered;
        }
    };

    // ---- constant after registration ----
    QString name;
    quint16 id = 0;
    QPlcSlaveNode::RealTimeViolationPolicy policy = QPlcSlaveNode::ErrorZeroOrderHold;
    bool listener = false;
    bool critical = false;                 // the plant must not go on without it
    bool hardware = false;                 // drives real devices
    bool goesOn = false;                   // it was in this phase before, lost its connection, and has kept its state
    std::chrono::nanoseconds watchdog{0};  // that it has set itself; 0: none
    ListeningInterval interval;            // longer than a cycle for listeners alone
    const TransportKind *transport = nullptr;  // null for a local node
    bool twoPhase = false;                     // the answer to cycle k holds the outputs of cycle k + 1
    QString faultPlan;                         // that the node injects; empty: none
    std::vector<bool> sameCycle;               // for each field of inputLayout
    NodeRuntime *local = nullptr;              // a node of this process; else over the network
    std::unique_ptr<HubPeer> peer;             // null for a local node
    PayloadLayout inputLayout;
    PayloadLayout outputLayout;
    std::vector<CopyRun> inputRuns;      // image -> inputs
    std::vector<CopyRun> sameCycleRuns;  // image -> same-cycle inputs, again when their writers have answered
    SignalGuard::Frame outputs;          // outputs -> image
    std::vector<char> initialOutputs;    // pasted into the image when a node joins while others run
    std::vector<char> initialInputs;     // that it was given before its first cycle

    // ---- cycle thread ----
    const SignalGuard::Frame *paste = nullptr;  // outputs, or those of them that the roster does not hold
    SignalGuard::Writer written;
    SignalGuard::Claims claims;
    FrameEncoder encoder;
    FrameDecoder decoder;
    std::uint64_t firstUnasked = 0;  // number on the wire: an answer to it or a later one is none
    std::vector<char> frames;        // encoded parts, one behind the other
    char *inputs
        = nullptr;  // payload of this cycle: where it lies in a frame of one part that is not sealed, else inputBytes
    std::vector<char> inputBytes;
    FrameHeader request;
    SentCycles sentCycles;         // of this phase; restarted before the slot is adopted
    std::size_t partsEncoded = 0;  // of the request; those stay as they are until it changes
    std::size_t partsSent = 0;     // of the request: a stream takes what the kernel has room for
    std::size_t bytesSent = 0;
    std::shared_ptr<MulticastPart> multicast;  // null: the node gets frames of its own
    quint32 multicastOffset = 0;               // of its inputs in the payload of the part
    std::uint64_t nextTurn = 0;                // of its interval
    bool due = false;                          // to be asked in this cycle
    bool asked = false;                        // in this cycle
    bool awaited = false;                      // its answer is waited for now
    bool answered = false;                     // in this cycle
    bool late = false;                         // in this cycle, and counted
    bool behind = false;                       // External: was given up, and has not answered since
    bool pending = false;                      // two-phase: the newest outputs are those of the next cycle
    bool computed = false;                     // local: the step of this cycle gave outputs
    bool faulted = false;
    Exchange exchange;

    // ---- both ----
    std::atomic<bool> lost{false};    // its connection is gone: not to be waited for
    std::atomic<int> bucket{0};       // fills with late answers and empties with those in time; see SafetyGuard
    std::atomic<bool> isSafe{false};  // says that it is in its safe state
    NodeStatistics statistics;

    /// Whether it can take part in cycles: its cyclic channel is there, or it needs none.
    bool isThere() const { return local || peer; }
    bool isRequestSent() const { return multicast || (partsSent == encoder.partCount() && !peer->hasRest()); }
    /// Whether its inputs travel together with those of other nodes.
    bool isInGroup() const { return transport && transport->hasGroup(); }
    bool waits() const { return policy == QPlcSlaveNode::SilentWait || policy == QPlcSlaveNode::ErrorWait; }
    bool reports() const
    {
        return policy == QPlcSlaveNode::ErrorZeroOrderHold || policy == QPlcSlaveNode::ErrorWait
            || policy == QPlcSlaveNode::SafeStopWhenLate;
    }

    /// The cycle to which the initial outputs belong when the next one is \a next.
    std::int64_t initialCycle(std::int64_t next) const { return twoPhase ? next : next - 1; }
    /// Whether it is asked in this cycle: in the first one of each turn that takes place. Once a
    /// cycle.
    bool takesTurn(std::uint64_t cycle) noexcept
    {
        const std::uint64_t turn = interval.turn(cycle);
        if (turn < nextTurn)
            return false;
        nextTurn = turn + 1;
        return true;
    }
    /// Sets everything that follows from the layouts. \param session of the master, for remote
    /// nodes
    /// \param keys  to seal its frames with, for this registration alone; null: they are not sealed
    void prepare(const ProcessImage &image, quint64 session, const SealKeys *keys = nullptr);
    FrameCutter outputCutter() const;
    /// Answers count from cycle \a first on (number on the wire), as soon as it is asked for.
    void expectFrom(std::uint64_t first) noexcept
    {
        decoder.restart(first);
        firstUnasked = first;
    }
};

}  // namespace qplc

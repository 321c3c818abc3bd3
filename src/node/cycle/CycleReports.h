// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "realtime/SpscRing.h"
#include "realtime/WakeUp.h"
#include "signals/PayloadRules.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace qplc {

/// Something that happened in a cycle and that the world wants to know.
struct CycleEvent
{
    enum Kind : std::uint8_t {
        LateAnswer,        // node, cycle: the answer was not there in time
        WaitingForNode,    // node, cycle: time stands still; node 0: for nodes whose policy is silent
        WaitingEnded,      // cycle
        NodeFaulted,       // node, cycle: the code of the node threw
        ForgedFrame,       // node, cycle: the first sealed frame of a phase that was not as it is sealed
        ValueRefused,      // node, signal, cycle, fault: the value was not taken
        SourceChanged,     // node, signal, cycle, duration: id of the node that was the source before
        SignalSafe,        // signal, cycle: no good value for too long
        LinkClosed,        // node: its cyclic connection is gone
        WatchdogTimedOut,  // cycle: no frame since
        Overrun,           // cycle, duration: it is that late, and the policy is Stop
        // The master stops safely from this cycle on, because of
        TrippedByLateAnswer,   // node, cycle: its policy
        TrippedByLateAnswers,  // node, cycle: a critical node is late too often
        TrippedByWait,         // node, cycle, duration: it was waited for so long
        TrippedByGap,          // cycle, duration: no cycle could begin for so long
        TrippedByOverruns,     // cycle: too many in a row
        TrippedByNode,         // node, cycle: it asked for that
        TrippedByFailure,      // node, cycle: the code of a critical node failed
        TrippedBySafeNode,     // node, cycle: a critical node is in its safe state
        ToldSafeStop,          // cycle: the master has told a node to be safe
        Ended                  // cycle: the cycle thread has left its loop
    };
    Kind kind = Ended;
    std::uint16_t node = 0;
    std::uint16_t signal = 0;
    std::uint64_t cycle = 0;
    std::int64_t duration = 0;  // [ns]
    ValueFault fault{};
};

/// A copy of a cyclic frame for the debug log.
struct TappedFrame
{
    enum Direction : std::uint8_t { Sent, Received };
    static constexpr std::size_t Capacity = 1472;
    Direction direction = Sent;
    std::uint16_t node = 0;
    std::uint16_t size = 0;
    std::array<char, Capacity> bytes;
};

/// How a cycle thread tells the thread of its owner what happened: rings, and a descriptor that
/// becomes readable when there is something in them. The cycle thread posts and never waits; a full
/// ring counts what it could not take. News of which there may be thousands at once (each late
/// answer, each signal that goes safe) leave room for what changes the state of a node, and this
/// for what is said once in a phase: that the master stops safely or has ended is never lost.
class CycleReports
{
public:
    /// \param tapFrames  whether tap() keeps frames
    explicit CycleReports(bool tapFrames);

    // cycle thread
    void post(const CycleEvent &event) noexcept;
    void tap(TappedFrame::Direction direction, std::uint16_t node, const char *frame, std::size_t size) noexcept
    {
        if (m_frames)
            keep(direction, node, frame, size);
    }

    // owner
    int descriptor() const { return m_wakeUp.descriptor(); }
    /// Calls \a onEvent and \a onFrame for all that is there, and waits for more on the descriptor.
    template<typename OnEvent, typename OnFrame>
    void take(OnEvent onEvent, OnFrame onFrame)
    {
        m_wakeUp.consume();
        drain(onEvent, onFrame);
        m_wakeUp.arm();
        drain(onEvent, onFrame);  // what came before arm() was heard
    }
    /// Whether there is something to take.
    bool isEmpty() { return !m_events.front() && (!m_frames || !m_frames->front()); }
    /// Events and frames that found their ring full.
    std::uint64_t dropped() const { return m_dropped.load(std::memory_order_relaxed); }

private:
    void keep(TappedFrame::Direction direction, std::uint16_t node, const char *frame, std::size_t size) noexcept;
    template<typename OnEvent, typename OnFrame>
    void drain(OnEvent &onEvent, OnFrame &onFrame)
    {
        for (CycleEvent event; m_events.pop(&event);)
            onEvent(event);
        while (const TappedFrame *frame = m_frames ? m_frames->front() : nullptr) {
            onFrame(*frame);
            m_frames->pop();
        }
    }

    static constexpr std::size_t Capacity = 1024;

    static std::size_t reserveAgainst(CycleEvent::Kind kind) noexcept;

    SpscRing<CycleEvent> m_events{Capacity};
    std::unique_ptr<SpscRing<TappedFrame>> m_frames;
    WakeUp m_wakeUp;
    std::atomic<std::uint64_t> m_dropped{0};
};

}  // namespace qplc
